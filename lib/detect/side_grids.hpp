#pragma once

#include "core/context.hpp"
#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Values of rows of a source's window, counted from the window's first, times a factor. @throws InputError
[[nodiscard]] MetreGrid read_grid(DemSource& source, RowBand rows, double factor, Context& context);
/// Where a source is neither 0 nor invalid. @throws InputError
[[nodiscard]] Mask read_mask(DemSource& source, RowBand rows, Context& context);
}  // namespace d2b
