#pragma once

#include <cstddef>
#include <vector>

#include "core/executor.hpp"
#include "core/lattice.hpp"
#include "outline/packed_outline.hpp"
#include "outline/wall_fit.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// The outlines of all contours with the staircase taken out of them. Clusters of contours are fitted on all
/// threads, and nothing is kept of them but polygons of some bytes a vertex.
class RegularOutlines {
  public:
    /// @param contours sorted by key; they stay the caller's and must outlive this
    RegularOutlines(const std::vector<Contour>& contours, const WallOptions& options, Executor& executor);

    /// A contour's outline: shared with neighbours and with other levels vertex for vertex.
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const { return outlines_[contour].polygon(); }
    [[nodiscard]] WallQuality quality(std::size_t contour) const { return outlines_[contour].quality; }
    /// Of a contour of level 0 or 1, as if nothing stood on it.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const { return low(contour).polygon(); }
    [[nodiscard]] WallQuality footprint_quality(std::size_t contour) const { return low(contour).quality; }
    /// A contour's outline as it was traced, with every corner that another one has on it.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    struct Kept {
        PackedOutline outline;
        WallQuality quality;
        [[nodiscard]] FinePolygon polygon() const { return outline.polygon(); }
    };
    [[nodiscard]] const Kept& low(std::size_t contour) const {
        return own_footprint_[contour] ? footprints_[contour] : outlines_[contour];
    }
    void keep(const WallCluster& cluster, const ClusterOutlines& fitted);

    std::vector<WallCluster> clusters_;
    std::vector<std::uint32_t> cluster_of_;  // a contour
    std::vector<Kept> outlines_;
    std::vector<Kept> footprints_;             // of contours of levels 0 and 1
    std::vector<std::uint8_t> own_footprint_;  // whether a contour's is another than its outline
};

}  // namespace d2b
