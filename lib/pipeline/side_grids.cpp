#include "pipeline/side_grids.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

constexpr std::int32_t rows_at_once = 256;

/// Calls use(index of the first value, values) for bands of rows.
template <typename Use>
void for_each_band(DemSource& source, Context& context, Use use) {
    const StageClock clock(context.report, Stage::read);
    const Window& window = source.info().window;
    std::vector<double> values;
    for (std::int32_t r = 0; r < window.rows; r += rows_at_once) {
        const std::int32_t rows = std::min(rows_at_once, window.rows - r);
        values.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(window.cols));
        source.read(window.row + r, rows, values);
        use(static_cast<std::size_t>(r) * static_cast<std::size_t>(window.cols), values);
    }
}

}  // namespace

MetreGrid read_grid(DemSource& source, double factor, Context& context) {
    MetreGrid grid(source.info().window.rows, source.info().window.cols);
    for_each_band(source, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            grid.values[first + i] = static_cast<float>(values[i] * factor);
    });
    return grid;
}

Mask read_mask(DemSource& source, Context& context) {
    Mask mask(source.info().window.rows, source.info().window.cols);
    for_each_band(source, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            mask.values[first + i] = !std::isnan(values[i]) && values[i] != 0 ? 1 : 0;
    });
    return mask;
}

void write_grid(RasterSink& sink, const MetreGrid& grid) {
    for (std::int32_t r = 0; r < grid.rows; r += rows_at_once) {
        const std::int32_t rows = std::min(rows_at_once, grid.rows - r);
        sink.write(
            rows, {grid.row(r).data(), static_cast<std::size_t>(rows) * static_cast<std::size_t>(grid.cols)});
    }
}

void write_values(RasterSink& sink, std::int32_t rows, std::int32_t cols,
                  const std::function<float(std::size_t i)>& value) {
    std::vector<float> values;
    std::size_t next = 0;
    for (std::int32_t r = 0; r < rows; r += rows_at_once) {
        const std::int32_t some = std::min(rows_at_once, rows - r);
        values.resize(static_cast<std::size_t>(some) * static_cast<std::size_t>(cols));
        for (float& each : values)
            each = value(next++);
        sink.write(some, values);
    }
}

}  // namespace d2b
