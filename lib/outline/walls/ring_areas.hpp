#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/int128.hpp"
#include "core/stop_request.hpp"
#include "outline/segment_grid.hpp"
#include "outline/walls/wall_clusters.hpp"
#include "outline/walls/wall_drawing.hpp"
#include "outline/walls/wall_marks.hpp"

namespace d2b {

/// Keeps the areas of a cluster's rings, as their arcs are drawn, near those of their traces.
class RingAreas {
  public:
    struct Ring {
        const std::vector<ArcUse>* uses = nullptr;
        std::int64_t traced = 0;  // area, in cells
        double length = 0;        // as traced, in steps
        int level = 0;
        bool waits = false;  // to be measured
        double missing = 0;  // area, when walls were moved last
        double asked = 0;    // of them
    };
    /// @param arcs as they are drawn
    /// @param inset cells by which walls were moved inward: areas may be less by as much
    /// @param stop must outlive this, as the others
    RingAreas(const WallCluster& cluster, const WallGraph& graph, const SegmentGrid::Arcs& arcs,
              WallDrawing& drawing, double inset, const StopRequest& stop);

    /// Takes notice of an arc that is drawn anew.
    void changed(std::uint32_t arc);
    /// Measures rings that have changed, and moves walls where an area is not kept, or has them drawn in a
    /// simpler form. @param in_conflict parts that change again: their rings wait @throws Cancelled
    void check(const std::vector<bool>& in_conflict);
    /// Twice the area, positive for exterior rings, in fine squares. Exact.
    [[nodiscard]] Int128 twice_area(const std::vector<ArcUse>& ring) const;
    /// A contour's: its exterior comes first.
    [[nodiscard]] std::span<const Ring> rings(std::size_t contour) const {
        return std::span(rings_).subspan(first_ring_[contour],
                                         first_ring_[contour + 1] - first_ring_[contour]);
    }

  private:
    using Wall = WallDrawing::Wall;

    void let_wait(std::uint32_t ring);
    void correct(Ring& ring, double missing);
    void simplify_last(const Ring& ring);
    [[nodiscard]] std::uint32_t part_of(std::uint32_t arc) const {
        return graph_.part_of[graph_.chain_of[arc]];
    }

    const WallCluster& cluster_;
    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    WallDrawing& drawing_;
    double inset_;
    const StopRequest& stop_;
    std::vector<Int128> areas_;              // of an arc and the origin, twice, in fine squares
    std::vector<Ring> rings_;                // exterior and interiors of one contour after the other
    std::vector<std::uint32_t> first_ring_;  // of a contour
    std::vector<std::uint32_t> rings_of_;    // arcs: those of one after the other
    std::vector<std::uint32_t> first_of_arc_;
    std::vector<std::uint32_t> waiting_rings_;
    WallMarks gathered_;  // walls of the ring that is corrected
    WallMarks moved_;     // walls, this round
};

}  // namespace d2b
