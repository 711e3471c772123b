#include "pipeline/scene_look.hpp"

#include <cmath>
#include <mutex>

namespace d2b {
namespace {

template <typename T, typename Counts>
bool any_known(const MetreGrid& surface, const Grid<T>& grid, RowBand rows, const Counts& counts) {
    for (std::size_t i = grid.index(rows.begin, 0); i < grid.index(rows.end, 0); ++i)
        if (!std::isnan(surface.values[i]) && counts(grid.values[i]))
            return true;
    return false;
}

}  // namespace

void add_fit(const MetreGrid& surface, const MetreGrid& ground, RowBand rows, GroundFit& fit,
             Executor& threads) {
    std::mutex mutex;
    for_row_bands(threads, rows.end - rows.begin, surface.cols, [&](RowBand band) {
        GroundFit some(fit.min_height());
        for (std::int32_t r = rows.begin + band.begin; r < rows.begin + band.end; ++r)
            some.add(surface.row(r), ground.row(r));
        const std::lock_guard lock(mutex);
        fit.merge(some);
    });
}

bool meets(const MetreGrid& surface, const Mask& mask, RowBand rows) {
    return any_known(surface, mask, rows, [](std::uint8_t allowed) { return allowed != 0; });
}

bool meets(const MetreGrid& surface, const MetreGrid& values, RowBand rows) {
    return any_known(surface, values, rows, [](float value) { return !std::isnan(value); });
}

}  // namespace d2b
