#include "detect/step_sharpness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

constexpr std::int32_t near = 1;  // cells
constexpr std::int32_t far = 3;

/// Sums over all border cells in mm.
struct Falls {
    std::int64_t within_near = 0;
    std::int64_t within_far = 0;

    void merge(const Falls& other) {
        within_near += other.within_near;
        within_far += other.within_far;
    }
};

bool has_free_side(const Mask& cells, std::int32_t r, std::int32_t c) {
    return cells.at(r - 1, c) == 0 || cells.at(r + 1, c) == 0 || cells.at(r, c - 1) == 0 ||
           cells.at(r, c + 1) == 0;
}

/// Returns the fall in mm to the lowest cell within a square. Cells without data are ignored.
std::int64_t fall(const MetreGrid& surface, std::int32_t r, std::int32_t c, std::int32_t reach) {
    const float here = surface.at(r, c);
    float lowest = here;
    for (std::int32_t y = std::max(r - reach, 0); y <= std::min(r + reach, surface.rows - 1); ++y)
        for (std::int32_t x = std::max(c - reach, 0); x <= std::min(c + reach, surface.cols - 1); ++x)
            lowest = std::min(lowest, surface.at(y, x));  // unchanged if the other one is NaN
    return std::llround(1000 * static_cast<double>(here - lowest));
}

}  // namespace

double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads) {
    const auto add_band = [&](RowBand band, Falls& falls) {
        for (std::int32_t r = std::max(band.begin, 1); r < std::min(band.end, objects.rows - 1); ++r)
            for (std::int32_t c = 1; c + 1 < objects.cols; ++c)
                if (objects.at(r, c) != 0 && has_free_side(objects, r, c) && !std::isnan(surface.at(r, c))) {
                    falls.within_near += fall(surface, r, c, near);
                    falls.within_far += fall(surface, r, c, far);
                }
    };
    const Falls all = sum_of_row_bands(threads, objects.rows, objects.cols, Falls(), add_band);
    return all.within_far > 0 ? static_cast<double>(all.within_near) / static_cast<double>(all.within_far)
                              : 1;
}

}  // namespace d2b
