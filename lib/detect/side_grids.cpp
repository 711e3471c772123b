#include "detect/side_grids.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/stage_clock.hpp"

namespace d2b {
namespace {

constexpr std::int32_t rows_at_once = 256;

/// Calls use(index of the first value, values) for each band of rows.
template <typename Use>
void for_each_band(DemSource& source, const Window& all, Context& context, Use use) {
    const StageClock clock(context.report, Stage::read);
    std::vector<double> values;
    std::size_t first = 0;
    for (std::int32_t r = all.row; r < all.end_row(); r += rows_at_once) {
        const Window band{r, all.col, std::min(rows_at_once, all.end_row() - r), all.cols};
        values.resize(static_cast<std::size_t>(band.points()));
        source.read(band, values);
        use(first, values);
        first += values.size();
    }
}

}  // namespace

MetreGrid read_grid(DemSource& source, const Window& part, double factor, Context& context) {
    MetreGrid grid(part.rows, part.cols);
    for_each_band(source, part, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            grid.values[first + i] = static_cast<float>(values[i] * factor);
    });
    return grid;
}

Mask read_mask(DemSource& source, const Window& part, Context& context) {
    Mask mask(part.rows, part.cols);
    for_each_band(source, part, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            mask.values[first + i] = !std::isnan(values[i]) && values[i] != 0 ? 1 : 0;
    });
    return mask;
}

}  // namespace d2b
