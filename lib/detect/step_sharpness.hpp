#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Sharpness of the steps at the borders of objects: the fall within one cell divided by the fall within
/// three. It is 1 for vertical walls, and a half or less if the raster is blurred, as in elevations from
/// satellite images or from a coarser raster. Returns 1 if nothing falls. Integer sums in mm, so the order
/// does not matter. Halo: three cells.
/// @param objects cells of objects
[[nodiscard]] double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads);

}  // namespace d2b
