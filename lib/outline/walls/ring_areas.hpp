#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "core/int128.hpp"
#include "core/stop_token.hpp"
#include "outline/segment_grid.hpp"
#include "outline/walls/wall_clusters.hpp"
#include "outline/walls/wall_layout.hpp"

namespace d2b::outline {

/// Preserves the areas of the rings of a cluster while their arcs are drawn.
class RingAreas {
  public:
    struct Ring {
        const std::vector<ArcUse>* uses = nullptr;
        std::int64_t traced = 0;  // area in cells
        double length = 0;        // traced length in steps
        int level = 0;
        bool pending = false;  // has yet to be measured
        double missing = 0;    // area missing when walls were last moved
        double requested = 0;  // area requested from them
    };
    /// @param arcs as drawn
    /// @param inset cells by which walls were moved inward; areas may shrink accordingly
    /// @param stop must outlive this, as must the others
    RingAreas(const WallCluster& cluster, const WallGraph& graph, const SegmentGrid::Arcs& arcs,
              WallLayout& layout, double inset, const StopToken& stop);

    /// Registers an arc that was redrawn.
    void changed(std::uint32_t arc);
    /// Measures the rings that have changed. If an area is not preserved, moves walls or has them drawn in a
    /// simpler mode. @param in_conflict components about to change again; their rings are postponed @throws
    /// Cancelled
    void check(const std::vector<bool>& in_conflict);
    /// Twice the area in fine squares, exact; positive for exterior rings.
    [[nodiscard]] Int128 twice_area(const std::vector<ArcUse>& ring) const;
    /// Rings of a contour, its exterior first.
    [[nodiscard]] std::span<const Ring> rings(std::size_t contour) const {
        return std::span(rings_).subspan(first_ring_[contour],
                                         first_ring_[contour + 1] - first_ring_[contour]);
    }

  private:
    using Wall = WallLayout::Wall;

    void enqueue(std::uint32_t ring);
    void restore_area(Ring& ring, double missing);
    void tighten_highest_rank(const Ring& ring);
    [[nodiscard]] std::uint32_t component_of(std::uint32_t arc) const {
        return graph_.component_of[graph_.chain_of[arc]];
    }

    const WallCluster& cluster_;
    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    WallLayout& layout_;
    double inset_;
    const StopToken& stop_;
    std::vector<Int128> areas_;  // per arc: twice the area between it and the origin, in fine squares
    std::vector<Ring> rings_;    // grouped by contour: exterior, then interiors
    std::vector<std::uint32_t> first_ring_;  // per contour
    GroupedIndices rings_of_;                // per arc
    std::vector<std::uint32_t> pending_rings_;
    std::set<Wall> moved_;  // walls moved in this round
};

}  // namespace d2b::outline
