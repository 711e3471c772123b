#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/lattice.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b {

/// How a fitted outline differs from its trace.
struct WallQuality {
    double simplified_share = 0;  ///< of the length of its rings that runs through the middles of steps
    double traced_share = 0;      ///< of the length of its rings that runs as it was traced
    double deviation = 0;         ///< cells: outline and trace are nowhere farther apart, either way
    double area_change = 0;       ///< share of the traced area
};

struct WallOutline {
    FinePolygon polygon;
    WallQuality quality;
};

/// The outlines of a cluster's contours with the staircase taken out of them.
struct ClusterOutlines {
    /// One a contour: shared with neighbours and with other levels vertex for vertex.
    std::vector<WallOutline> outlines;
    /// Of the contours of levels 0 and 1, which come first, without the vertices that higher levels alone
    /// need; empty where there are none of these.
    std::vector<WallOutline> footprints;
};

/// Fits walls:
///
///     WallCluster                     contours that can get into each other's way
///        |  build_wall_graph()
///        v
///     WallGraph                       their arcs, as few as there are; arcs of one rank make Chains
///        |  WallDrawing               the chains of low rank first:
///        v                              ChainDrawing: turning_points(), plan_walls(), find_circular_arcs(),
///                                       draw_walls(), and compose_chain() where a ChainForm says Middles
///     Course                          a chain as it is drawn, and where the nodes of others stand on it
///        |  WallCheck, PartCheck      is it still the figure that was traced? exactly, on integers
///        |  RingAreas                 are areas kept?
///        v
///     WallRounds                      what is in the way follows its trace closer there, and all that again
///        |
///        v
///     DrawnOutlines                   the contours' outlines, from the arcs that they share
///
/// Depends on the cluster alone; O(n log n) in corners, and some rounds where walls are in each
/// other's way. @throws Cancelled
[[nodiscard]] ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options,
                                        const StopRequest& stop = {});

}  // namespace d2b
