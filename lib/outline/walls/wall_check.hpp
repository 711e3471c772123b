#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outline/segment_grid.hpp"
#include "outline/walls/part_check.hpp"

namespace d2b {

/// Exact tests that a drawing of a graph is the same plane figure as its trace, up to how its walls run:
///  - edges of arcs have no point in common but the nodes in which their arcs meet;
///  - around every node, the contour on one side of an arc is that beside the next one;
///  - every connected part of the graph lies in the contour in which it was traced.
/// Then each contour is what its rings bound: rings are simple, interior rings lie inside, contours of one
/// level have no point of their inside in common and lie in those of the level below.
/// What has not changed since it was tested is not tested again.
class WallCheck {
  public:
    /// @param arcs as they are drawn, some or all of them not yet
    /// @param tolerance cells: no arc has left its trace by more
    /// @param stop must outlive this, as the others
    WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance,
              const StopRequest& stop);

    /// Whether an arc is of interest although it has not changed: it may come in the way of others now.
    [[nodiscard]] bool notices(std::uint32_t arc) const { return in_conflict_[arc] != 0; }
    /// Takes notice of arcs that are drawn anew. Those that were in conflict are tested again.
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
    std::vector<std::uint8_t> changed_;      // arcs, this time
    std::vector<std::uint8_t> in_conflict_;  // arcs, since they were tested last
    std::vector<std::uint32_t> conflicting_;
    std::vector<std::uint32_t> tested_;     // arcs, this time
    std::vector<std::uint8_t> node_waits_;  // to be checked
    std::vector<std::uint32_t> waiting_nodes_;
    std::vector<std::uint32_t> ends_;  // at a node, in order
    PartCheck parts_;
};

}  // namespace d2b
