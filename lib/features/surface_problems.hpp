#pragma once

#include <vector>

#include "features/problem_layer.hpp"
#include "features/surface_cluster.hpp"
#include "surface/level_roofs.hpp"

namespace d2b {

/// Puts the buildings that make_surfaces() has left out beside those that were lost before.
void add_left_out(const DrawnCluster& drawn, const MadeSurfaces& made, std::vector<LostBuilding>& lost);

/// What was in the way of a cluster's surfaces: pinches that were taken apart, and lost buildings that have a
/// place. @param frame of the lattice that they are on
[[nodiscard]] std::vector<PlacedProblem> surface_problems(const SurfaceCluster& cluster,
                                                          const MadeSurfaces& made,
                                                          const std::vector<LostBuilding>& lost,
                                                          const SurfaceFrame& frame);

/// Steps between roofs that were lower than -min_wall, and what became of them.
[[nodiscard]] std::vector<PlacedProblem> step_problems(const SurfaceCluster& cluster,
                                                       const std::vector<RoofStep>& steps,
                                                       const SurfaceFrame& frame);

}  // namespace d2b
