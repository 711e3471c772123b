#pragma once

#include <vector>

#include "features/problem_layer.hpp"
#include "features/surface_cluster.hpp"
#include "surface/level_roofs.hpp"

namespace d2b {

/// Adds the buildings rejected by make_surfaces() to those lost before.
void add_left_out(const DrawnCluster& drawn, const MadeSurfaces& made, std::vector<LostBuilding>& lost);

/// Returns the problems of a cluster's surfaces: resolved non-manifold vertices, and lost buildings with a
/// known position. @param frame of the lattice
[[nodiscard]] std::vector<PlacedProblem> surface_problems(const SurfaceCluster& cluster,
                                                          const MadeSurfaces& made,
                                                          const std::vector<LostBuilding>& lost,
                                                          const SurfaceFrame& frame);

/// Returns the roof steps lower than -min_wall and their resolution.
[[nodiscard]] std::vector<PlacedProblem> step_problems(const SurfaceCluster& cluster,
                                                       const std::vector<RoofStep>& steps,
                                                       const SurfaceFrame& frame);

}  // namespace d2b
