#pragma once

#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Reads a part of a source's window and multiplies it by a factor.
/// @throws InputError
[[nodiscard]] MetreGrid read_grid(DemSource& source, const Window& part, double factor, Context& context);
/// Reads a mask: cells that are neither 0 nor invalid.
/// @throws InputError
[[nodiscard]] Mask read_mask(DemSource& source, const Window& part, Context& context);

}  // namespace d2b
