#pragma once

#include <vector>

#include "features/surface_cluster.hpp"

namespace d2b {

/// The buildings of a group as the tiers of their stacks, a part each, with their numbers and without values.
/// @param drawn from contours (SurfaceOf::contours)
[[nodiscard]] std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                                      const SurfaceLattice& lattice);

}  // namespace d2b
