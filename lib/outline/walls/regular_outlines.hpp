#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/executor.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/spool.hpp"
#include "outline/noding.hpp"
#include "outline/walls/fit_walls.hpp"
#include "outline/walls/wall_clusters.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// Regularized outlines of all contours. Clusters of contours are fitted in parallel and the results are
/// spooled, at a few bytes per vertex.
class RegularOutlines {
  public:
    /// @param contours must outlive this @throws Cancelled
    RegularOutlines(const ContourList& contours, const WallOptions& options, std::unique_ptr<Spool> spool,
                    Executor& executor);

    /// Outline of a contour; neighbours and other levels share vertices exactly.
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const { return fetch(outlines_[contour]); }
    [[nodiscard]] WallQuality quality(std::size_t contour) const { return outlines_[contour].quality; }
    /// Outline of a contour of level 0 or 1 without vertices of higher levels.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const { return fetch(low(contour)); }
    [[nodiscard]] WallQuality footprint_quality(std::size_t contour) const { return low(contour).quality; }
    /// Groups of contours whose walls were fitted together.
    [[nodiscard]] const std::vector<ClusterPlan>& clusters() const { return clusters_; }
    /// Traced outline of a contour, with every corner of other contours on it.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    struct Kept {
        SpoolEntry place;  // empty if there is none
        WallQuality quality;
    };
    [[nodiscard]] const Kept& low(std::size_t contour) const {
        return contour < footprints_.size() && footprints_[contour].place.size > 0 ? footprints_[contour]
                                                                                   : outlines_[contour];
    }
    /// Caches the corners of large clusters on first use, because otherwise each contour that GEOS rejects
    /// would load its whole cluster.
    struct LargeClusters {
        std::mutex mutex;
        std::map<std::uint32_t, std::shared_ptr<const CornerIndex>> corners;
    };
    [[nodiscard]] std::shared_ptr<const CornerIndex> corners(std::uint32_t cluster) const;
    [[nodiscard]] Kept keep(const WallOutline& outline);
    [[nodiscard]] FinePolygon fetch(const Kept& kept) const;

    const ContourList& contours_;
    std::unique_ptr<Spool> spool_;
    std::vector<ClusterPlan> clusters_;
    std::vector<std::uint32_t> cluster_of_;  // per contour
    std::vector<Kept> outlines_;
    std::vector<Kept> footprints_;  // footprints of levels 0 and 1 that differ from their outlines
    std::unique_ptr<LargeClusters> large_clusters_;
};

}  // namespace d2b
