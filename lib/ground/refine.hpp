#pragma once

#include "ground/aligned_grid.hpp"
#include "ground/ground.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// The terrain at every point of the surface: points near the working terrain are ground, elsewhere it lies
/// where the working terrain does, and never above the surface.
/// @param outliers the height below which points are low outliers, on the working grid; empty
/// where none are
[[nodiscard]] Terrain refine(const MetreGrid& surface, const GridPlace& place, const AlignedGrid& working,
                             const MetreGrid& outliers, Factor factor, const Rules& rules);

}  // namespace d2b::ground
