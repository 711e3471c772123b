#pragma once

#include <cstdint>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_options.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// Contours whose walls are fitted together.
struct WallCluster {
    std::vector<const Contour*> contours;  ///< parents before their children
    std::vector<std::int32_t> parents;     ///< place of each one's parent among them; -1: it is not with them
};

/// The same before its contours are fetched.
struct ClusterPlan {
    std::vector<std::uint32_t> numbers;  ///< place of each contour in the list, ascending
    std::vector<std::int32_t> parents;   ///< as WallCluster's
};

/// Rows and columns over which two traces can get into each other's way: both walls stay within the
/// tolerance.
[[nodiscard]] LatticePoint conflict_reach(const WallOptions& options);

/// Divides contours into clusters that cannot get into each other's way: what stands on one contour of level
/// 1 is together, and so are contours whose traces come so near each other that their walls could meet. Which
/// contours share a cluster depends on nothing but these. O(n) in corners of levels 0 and 1, but for crowds;
/// in memory are the corners of a strip.
/// @param rows_a_strip that are looked at together
/// @return sorted by their first contours @throws Cancelled
[[nodiscard]] std::vector<ClusterPlan> wall_clusters(const ContourList& contours, const WallOptions& options,
                                                     const StopRequest& stop = {},
                                                     std::int64_t rows_a_strip = 4096);

/// The contours of a cluster.
class FetchedCluster {
  public:
    /// @throws Cancelled
    FetchedCluster(const ContourList& contours, const ClusterPlan& plan, const StopRequest& stop = {});
    FetchedCluster(const FetchedCluster&) = delete;
    FetchedCluster& operator=(const FetchedCluster&) = delete;
    ~FetchedCluster() = default;

    [[nodiscard]] const WallCluster& cluster() const { return cluster_; }

  private:
    std::vector<Contour> contours_;
    WallCluster cluster_;
};

}  // namespace d2b
