#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/raster_sink.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Values of rows of a source's window, counted from the window's first, times a factor. @throws InputError
[[nodiscard]] MetreGrid read_grid(DemSource& source, RowBand rows, double factor, Context& context);
/// Where a source is neither 0 nor invalid. @throws InputError
[[nodiscard]] Mask read_mask(DemSource& source, RowBand rows, Context& context);
/// Rows of a grid; the sink is not finished. @throws OutputError
void write_grid(RasterSink& sink, const MetreGrid& grid, RowBand rows);
/// The same, value(i) for each cell: i is its index in a grid of as many columns. @throws OutputError
void write_values(RasterSink& sink, RowBand rows, std::int32_t cols,
                  const std::function<float(std::size_t i)>& value);

}  // namespace d2b
