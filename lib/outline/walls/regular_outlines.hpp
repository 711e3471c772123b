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

/// The outlines of all contours with the staircase taken out of them. Clusters of contours are fitted on all
/// threads, and what was drawn is put aside, in some bytes a vertex.
class RegularOutlines {
  public:
    /// @param contours they stay the caller's and must outlive this @throws Cancelled
    RegularOutlines(const ContourList& contours, const WallOptions& options, std::unique_ptr<Spool> spool,
                    Executor& executor);

    /// A contour's outline: shared with neighbours and with other levels vertex for vertex.
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const { return fetch(outlines_[contour]); }
    [[nodiscard]] WallQuality quality(std::size_t contour) const { return outlines_[contour].quality; }
    /// Of a contour of level 0 or 1, as if nothing stood on it.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const { return fetch(low(contour)); }
    [[nodiscard]] WallQuality footprint_quality(std::size_t contour) const { return low(contour).quality; }
    /// Contours whose walls were fitted together.
    [[nodiscard]] const std::vector<ClusterPlan>& clusters() const { return clusters_; }
    /// A contour's outline as it was traced, with every corner that another one has on it.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    struct Kept {
        SpoolEntry place;  // empty: there is none
        WallQuality quality;
    };
    [[nodiscard]] const Kept& low(std::size_t contour) const {
        return contour < footprints_.size() && footprints_[contour].place.size > 0 ? footprints_[contour]
                                                                                   : outlines_[contour];
    }
    /// The corners of clusters of many contours, once they were asked for: else each contour that GEOS
    /// refuses would load all of its cluster.
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
    std::vector<std::uint32_t> cluster_of_;  // a contour
    std::vector<Kept> outlines_;
    std::vector<Kept> footprints_;  // of contours of levels 0 and 1 that differ from their outlines
    std::unique_ptr<LargeClusters> large_clusters_;
};

}  // namespace d2b
