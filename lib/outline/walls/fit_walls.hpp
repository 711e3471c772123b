#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/lattice.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b {

/// Measures of the difference between a fitted outline and its trace.
struct WallQuality {
    double simplified_share = 0;  ///< share of the length of its rings that passes through midpoints of steps
    double traced_share = 0;      ///< share of the length of its rings that keeps the trace
    double deviation = 0;    ///< cells; upper bound of both Hausdorff distances between outline and trace
    double area_change = 0;  ///< relative to the traced area
};

struct WallOutline {
    FinePolygon polygon;
    WallQuality quality;
};

/// Regularized outlines of the contours of a cluster.
struct ClusterOutlines {
    /// One per contour; neighbours and other levels share vertices exactly.
    std::vector<WallOutline> outlines;
    /// Outlines of the contours of levels 0 and 1, which come first, without the vertices that only higher
    /// levels need; empty if there are no higher levels.
    std::vector<WallOutline> footprints;
};

/// Fits walls, i.e. replaces the staircases of traced contours by straight lines and circular arcs:
///
///     WallCluster                     contours whose walls can conflict
///        |  build_wall_graph()
///        v
///     WallGraph                       their arcs, as few as possible; arcs of one rank form Chains
///        |  WallDrawing               draws chains by rank, lowest first:
///        v                              ChainDrawing: turning_points(), plan_walls(), find_circular_arcs(),
///                                       draw_walls(), and compose_chain() if a ChainForm contains Middles
///     Course                          a drawn chain and the positions of the nodes on it
///        |  WallCheck, PartCheck      is the topology that of the trace? exact, with integers
///        |  RingAreas                 are areas preserved?
///        v
///     WallRounds                      conflicting parts follow their trace more closely; repeat
///        |
///        v
///     DrawnOutlines                   outlines of the contours, assembled from the shared arcs
///
/// Depends only on the cluster, so the results do not depend on threads or tiles. O(n log n) in the number of
/// corners, plus some rounds for conflicts. @throws Cancelled
[[nodiscard]] ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options,
                                        const StopRequest& stop = {});

}  // namespace d2b
