#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contours/contour.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/options.hpp"
#include "outline/walls/trace_sums.hpp"

namespace d2b::outline {

/// Parameters of wall fitting.
struct WallOptions {
    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    CellShape shape;
    double inset = 0;                      ///< cells by which walls are moved inward
    double price = 1;                      ///< of a wall, in cells of area that it has to be worth
    double vertical_metres = 1;            ///< metres per unit of elevation
    std::optional<LatticeBox> frame = {};  ///< of the raster, which cuts buildings off
};

/// Contours whose walls are fitted together.
struct WallCluster {
    std::vector<contours::Contour> contours;  ///< parents before children
    std::vector<std::int32_t>
        parents;                ///< index of the parent of each contour; -1 if it is not in the cluster
    std::vector<double> tiers;  ///< tier_z of each contour
};

/// Indices of a cluster whose contours have not been fetched.
struct ClusterPlan {
    std::vector<std::uint32_t> numbers;  ///< index of each contour in the list, ascending
    std::vector<std::int32_t> parents;   ///< see WallCluster
};

/// Rows and columns within which two traces may conflict, because both walls stay within the tolerance.
[[nodiscard]] LatticePoint conflict_distance(const WallOptions& options);

/// Divides contours into clusters that cannot conflict. Contours on the same contour of level 1 share a
/// cluster, as do contours whose traces are so close that their walls could meet. The division depends only
/// on the contours. O(n) in the number of corners of levels 0 and 1 unless they are crowded; only the corners
/// of one strip are in memory.
/// @param rows_per_strip rows processed together
/// @return sorted by their first contours @throws Cancelled
[[nodiscard]] std::vector<ClusterPlan> wall_clusters(const contours::ContourList& contours,
                                                     const WallOptions& options, const StopToken& stop = {},
                                                     std::int64_t rows_per_strip = 4096);

/// @throws Cancelled
[[nodiscard]] WallCluster fetch_cluster(const contours::ContourList& contours, const ClusterPlan& plan,
                                        const StopToken& stop = {});

}  // namespace d2b::outline
