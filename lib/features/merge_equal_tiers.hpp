#pragma once

#include "features/surface_cluster.hpp"

namespace d2b {

/// Merges each tier with the one below if their areas differ by at most 0.1 %: the outline of the lower one
/// is kept, at the height of the upper one. Also merges tiers that would no longer be higher than the tier
/// below.
/// @param drawn contours of surfaces; merged tiers are removed
void merge_equal_tiers(DrawnCluster& drawn);

}  // namespace d2b
