#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/context.hpp"
#include "core/dem_source.hpp"
#include "core/grid.hpp"
#include "core/raster_sink.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// All values of a source's window, times a factor. @throws InputError
[[nodiscard]] MetreGrid read_grid(DemSource& source, double factor, Context& context);
/// Where a source is neither 0 nor invalid. @throws InputError
[[nodiscard]] Mask read_mask(DemSource& source, Context& context);
/// All rows of a grid; the sink is not finished. @throws OutputError
void write_grid(RasterSink& sink, const MetreGrid& grid);
/// The same, value(i) for each cell. @throws OutputError
void write_values(RasterSink& sink, std::int32_t rows, std::int32_t cols,
                  const std::function<float(std::size_t i)>& value);

}  // namespace d2b
