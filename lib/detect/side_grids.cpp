#include "detect/side_grids.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/stage_clock.hpp"

namespace d2b {
namespace {

constexpr std::int32_t rows_at_once = 256;

/// Calls use(index of the first value, values) for bands of rows.
template <typename Use>
void for_each_band(DemSource& source, RowBand all, Context& context, Use use) {
    const StageClock clock(context.report, Stage::read);
    const Window& window = source.info().window;
    std::vector<double> values;
    std::size_t first = 0;
    for (std::int32_t r = all.begin; r < all.end; r += rows_at_once) {
        const std::int32_t rows = std::min(rows_at_once, all.end - r);
        values.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(window.cols));
        source.read(window.row + r, rows, values);
        use(first, values);
        first += values.size();
    }
}

}  // namespace

MetreGrid read_grid(DemSource& source, RowBand rows, double factor, Context& context) {
    MetreGrid grid(rows.end - rows.begin, source.info().window.cols);
    for_each_band(source, rows, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            grid.values[first + i] = static_cast<float>(values[i] * factor);
    });
    return grid;
}

Mask read_mask(DemSource& source, RowBand rows, Context& context) {
    Mask mask(rows.end - rows.begin, source.info().window.cols);
    for_each_band(source, rows, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            mask.values[first + i] = !std::isnan(values[i]) && values[i] != 0 ? 1 : 0;
    });
    return mask;
}

}  // namespace d2b
