#pragma once

#include <vector>

#include "features/surface_cluster.hpp"

namespace d2b {

/// Converts the buildings of a cluster to stacks of tiers, one part per building, with ids but without field
/// values.
/// @param drawn from contours (SurfaceOf::contours)
[[nodiscard]] std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                                      const SurfaceLattice& lattice);

}  // namespace d2b
