#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outline/segment_grid.hpp"
#include "outline/walls/part_check.hpp"

namespace d2b {

/// Exact test that a drawn graph has the topology of its trace:
///  - edges of arcs only share the nodes at which their arcs meet;
///  - around every node, consecutive arcs agree on the contour between them;
///  - every connected component of the graph lies in the contour in which it was traced.
/// Together these imply valid polygons: rings are simple, interior rings lie inside, the interiors of
/// contours of one level are disjoint and lie within those of the level below. Only changed arcs and previous
/// conflicts are tested, because few arcs change in a round.
class WallCheck {
  public:
    /// @param arcs as drawn; some or all may still be empty
    /// @param tolerance largest distance in cells between an arc and its trace
    /// @param stop must outlive this, as must the others
    WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance,
              const StopRequest& stop);

    /// True if an arc must be reported even if unchanged, because it was in conflict.
    [[nodiscard]] bool notices(std::uint32_t arc) const { return in_conflict_[arc] != 0; }
    /// Updates redrawn arcs and tests them together with those previously in conflict.
    /// @param changed sorted
    /// @return sorted @throws Cancelled
    [[nodiscard]] WallConflicts conflicts(const std::vector<std::uint32_t>& changed);
    [[nodiscard]] std::span<const std::uint32_t> arcs_of_part(std::uint32_t part) const {
        return parts_.arcs_of(part);
    }

  private:
    using Edge = SegmentGrid::Edge;

    void update(std::uint32_t arc);
    void keep(std::uint32_t arc);
    [[nodiscard]] bool joined(Edge e, Edge f) const;
    [[nodiscard]] bool conflict(Edge e, const FineSegment& s, Edge f, const FineSegment& t) const;
    void check_arc(std::uint32_t arc, WallConflicts& found);
    [[nodiscard]] Edge edge_at(std::uint32_t end) const;
    void check_nodes(WallConflicts& found);
    void check_node(std::uint32_t node, WallConflicts& found);

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    SegmentGrid grid_;
    const StopRequest& stop_;
    std::vector<std::uint8_t> changed_;      // per arc, in this call
    std::vector<std::uint8_t> in_conflict_;  // per arc, since its last test
    std::vector<std::uint32_t> conflicting_;
    std::vector<std::uint32_t> tested_;     // arcs tested in this call
    std::vector<std::uint8_t> node_waits_;  // per node: has yet to be checked
    std::vector<std::uint32_t> waiting_nodes_;
    std::vector<std::uint32_t> ends_;  // arc ends at a node, in angular order
    PartCheck parts_;
};

}  // namespace d2b
