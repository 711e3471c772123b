#pragma once

#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/ground.hpp"
#include "ground/outliers.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Computes the terrain at every point of the surface: points near the working terrain are ground; elsewhere
/// the terrain equals the working terrain but is never above the surface.
/// @param working its memory becomes the result's if its cells are those of the surface
/// @param pits of the working grid, in scan order: points below their limits are low outliers
[[nodiscard]] Terrain refine(const MetreGrid& surface, const GridPlace& place, AlignedGrid working,
                             const std::vector<Pit>& pits, Factor factor, const Rules& rules,
                             Executor& threads);

}  // namespace d2b::ground
