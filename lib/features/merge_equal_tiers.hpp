#pragma once

#include "features/surface_cluster.hpp"

namespace d2b {

/// Merges tiers with those below them whose areas are equal within 0.1 %: the outline of the lower one stays,
/// at the height of the higher one. Other tiers that would then be no higher than what they stand on go with
/// them. @param drawn contours of surfaces; without the tiers that are merged afterwards
void merge_equal_tiers(DrawnCluster& drawn);

}  // namespace d2b
