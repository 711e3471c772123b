#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "contours/contour.hpp"
#include "core/executor.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/spool.hpp"
#include "outline/arc_graph.hpp"
#include "outline/outline.hpp"
#include "outline/packed_outline.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b::outline {

struct WallOutline {
    FinePolygon polygon;
    OutlineQuality quality;
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
///        |  WallLayout                draws chains by rank, lowest first:
///        v                              ChainFitter: find_circular_arcs(), find_walls(), draw_walls(),
///                                       compose_chain() if steps have another FitMode
///     PlacedPolyline                  a drawn chain and the positions of the nodes on it
///        |  WallCheck, ContainmentCheck  is the topology that of the trace? exact, with integers
///        |  RingAreas                 are areas preserved?
///        v
///     WallFitter                      conflicting parts follow their trace more closely; repeat
///        |
///        v
///     OutlineBuilder                  outlines of the contours, assembled from the shared arcs
///
/// Depends only on the cluster, so the results do not depend on threads or tiles. O(n log n) in the number of
/// corners, plus some rounds for conflicts. @throws Cancelled
[[nodiscard]] ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options,
                                        const StopToken& stop = {});

/// Regularized outlines of all contours. Clusters of contours are fitted in parallel and the results are
/// spooled, at a few bytes per vertex.
class RegularizedOutlines {
  public:
    /// @param contours must outlive this @throws Cancelled
    RegularizedOutlines(const contours::ContourList& contours, const WallOptions& options,
                        std::unique_ptr<Spool> spool, Executor& executor);

    /// Outline of a contour; neighbours and other levels share vertices exactly.
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const {
        return load_outline(*spool_, outlines_[contour].place);
    }
    [[nodiscard]] OutlineQuality quality(std::size_t contour) const { return outlines_[contour].quality; }
    /// Outline of a contour of level 0 or 1 without vertices of higher levels.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const {
        return load_outline(*spool_, low(contour).place);
    }
    [[nodiscard]] OutlineQuality footprint_quality(std::size_t contour) const { return low(contour).quality; }
    /// Groups of contours whose walls were fitted together.
    [[nodiscard]] const std::vector<ClusterPlan>& clusters() const { return clusters_; }
    /// Traced outline of a contour, with every corner of other contours on it.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    [[nodiscard]] const SpooledOutline& low(std::size_t contour) const {
        return contour < footprints_.size() && footprints_[contour].place.size > 0 ? footprints_[contour]
                                                                                   : outlines_[contour];
    }
    /// Caches the noded rings of large clusters on first use, because otherwise each contour that GEOS
    /// rejects would load its whole cluster.
    struct LargeClusters {
        std::mutex mutex;
        std::map<std::uint32_t, std::shared_ptr<const NodedRings>> rings;
    };
    [[nodiscard]] std::shared_ptr<const NodedRings> rings(std::uint32_t cluster) const;

    const contours::ContourList& contours_;
    std::unique_ptr<Spool> spool_;
    std::vector<ClusterPlan> clusters_;
    std::vector<std::uint32_t> cluster_of_;  // per contour
    std::vector<SpooledOutline> outlines_;
    std::vector<SpooledOutline> footprints_;  // footprints of levels 0 and 1 that differ from their outlines
    std::unique_ptr<LargeClusters> large_clusters_;
};

}  // namespace d2b::outline
