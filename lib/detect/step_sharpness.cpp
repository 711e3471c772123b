#include "detect/step_sharpness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

constexpr std::int32_t near = 1;  // cells
constexpr std::int32_t far = 3;

bool on_border(const Mask& cells, std::int32_t r, std::int32_t c) {
    return cells.at(r - 1, c) == 0 || cells.at(r + 1, c) == 0 || cells.at(r, c - 1) == 0 ||
           cells.at(r, c + 1) == 0;
}

/// Millimetres down to the lowest cell within a square. Cells that are not valid do not count.
std::int64_t fall(const MetreGrid& surface, std::int32_t r, std::int32_t c, std::int32_t reach) {
    const float here = surface.at(r, c);
    float lowest = here;
    for (std::int32_t y = std::max(r - reach, 0); y <= std::min(r + reach, surface.rows - 1); ++y)
        for (std::int32_t x = std::max(c - reach, 0); x <= std::min(c + reach, surface.cols - 1); ++x)
            lowest = std::min(lowest, surface.at(y, x));  // itself where the other is NaN
    return std::llround(1000 * static_cast<double>(here - lowest));
}

}  // namespace

double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads) {
    std::int64_t all_near = 0;
    std::int64_t all_far = 0;
    std::mutex mutex;
    for_row_bands(threads, objects.rows, objects.cols, [&](RowBand band) {
        std::int64_t band_near = 0;
        std::int64_t band_far = 0;
        for (std::int32_t r = std::max(band.begin, 1); r < std::min(band.end, objects.rows - 1); ++r)
            for (std::int32_t c = 1; c + 1 < objects.cols; ++c)
                if (objects.at(r, c) != 0 && on_border(objects, r, c) && !std::isnan(surface.at(r, c))) {
                    band_near += fall(surface, r, c, near);
                    band_far += fall(surface, r, c, far);
                }
        const std::lock_guard lock(mutex);
        all_near += band_near;
        all_far += band_far;
    });
    return all_far > 0 ? static_cast<double>(all_near) / static_cast<double>(all_far) : 1;
}

}  // namespace d2b
