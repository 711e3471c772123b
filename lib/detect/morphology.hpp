#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Cells around which all cells within a radius are set; the border continues outwards. Where the radius is
/// less than a cell, a block of two by two cells takes the disk's place. Halo: the radius.
[[nodiscard]] Mask eroded(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// What a disk of this radius fits into: thin bridges and spikes go. Where the radius is less than a cell, a
/// block of two by two cells takes the disk's place. The border continues outwards. Halo: twice the
/// radius.
[[nodiscard]] Mask opened(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// Adds the neighbours across edges that lie in `within`, so many times. Halo: a cell a step.
[[nodiscard]] Mask grown(Mask mask, const Mask& within, int steps, Executor& threads);

}  // namespace d2b
