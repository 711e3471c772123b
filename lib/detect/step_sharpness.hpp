#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// How sharp the steps at the border of objects are: what they fall within one cell, of what they fall within
/// three. 1 where a wall falls at once, a half and less where a blur has smeared it, as in elevations from
/// satellite images or from a coarser raster. 1 where nothing falls. Sums of whole millimetres: their order
/// does not matter. Halo: three cells.
/// @param objects cells that belong to one
[[nodiscard]] double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads);

}  // namespace d2b
