#pragma once

#include <cstdint>
#include <vector>

#include "outline/wall_options.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// Contours whose walls are fitted together.
struct WallCluster {
    std::vector<const Contour*> contours;  ///< parents before their children
    std::vector<std::int32_t> parents;     ///< place of each one's parent among them; -1: it is not with them
    std::vector<std::uint32_t> numbers;    ///< place of each among all contours that were divided, ascending
};

/// Divides contours into clusters that cannot get into each other's way: what stands on one contour of level
/// 1 is together, and so are contours whose traces come so near each other that their walls could meet. Which
/// contours share a cluster depends on nothing but these. O(n) in corners of levels 0 and 1, but for crowds.
/// @param contours sorted by key; they stay the caller's and must outlive the clusters
/// @return sorted by their first contours
[[nodiscard]] std::vector<WallCluster> wall_clusters(const std::vector<Contour>& contours,
                                                     const WallOptions& options);

}  // namespace d2b
