#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Erosion by a disk; the border is replicated. If the radius is less than a cell, the structuring element is
/// a block of two by two cells. Halo: the radius.
[[nodiscard]] Mask eroded(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// Opening by a disk, which removes thin bridges and spikes. If the radius is less than a cell, the
/// structuring element is a block of two by two cells. The border is replicated. Halo: twice the radius.
[[nodiscard]] Mask opened(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// Geodesic dilation: adds 4-neighbours within `within`, `steps` times. Halo: one cell per step.
[[nodiscard]] Mask grown(Mask mask, const Mask& within, int steps, Executor& threads);

}  // namespace d2b
