#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "outline/segment_grid.hpp"
#include "outline/wall_drawing.hpp"

namespace d2b {

/// Exact tests that a drawing of a graph is the same plane figure as its trace, up to how its walls run:
///  - edges of arcs have no point in common but the nodes in which their arcs meet;
///  - around every node, the contour on one side of an arc is that beside the next one;
///  - every connected part of the graph lies in the contour in which it was traced.
/// Then each contour is what its rings bound: rings are simple, interior rings lie inside, contours of one
/// level have no point of their inside in common and lie in those of the level below.
/// What has not changed since it was tested is not tested again, and traces are not tested against each
/// other.
class WallCheck {
  public:
    using Conflicts = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

    /// @param arcs as they are drawn, some or all of them not yet
    /// @param tolerance cells: no arc has left its trace by more
    /// @param stop must outlive this, as the others
    WallCheck(const WallGraph& graph, const WallDrawing& drawing, const SegmentGrid::Arcs& arcs,
              double tolerance, const StopRequest& stop);

    /// Whether an arc is of interest although it has not changed: it may come in the way of others now.
    [[nodiscard]] bool notices(std::uint32_t arc) const {
        return in_conflict_[arc] != 0 || (as_traced_[arc] != 0) != traced(arc);
    }
    /// Takes notice of arcs that are drawn anew. Those that were in conflict are tested again.
    /// @param changed sorted
    /// @return pairs of chains that are in each other's way, sorted @throws Cancelled
    [[nodiscard]] Conflicts conflicts(const std::vector<std::uint32_t>& changed);
    [[nodiscard]] std::span<const std::uint32_t> arcs_of_part(std::uint32_t part) const {
        return std::span(part_arcs_)
            .subspan(first_of_part_[part], first_of_part_[part + 1] - first_of_part_[part]);
    }

  private:
    using Edge = SegmentGrid::Edge;

    [[nodiscard]] bool traced(std::uint32_t arc) const {
        return drawing_.drawn(graph_.chain_of[arc]) == WallDrawing::Form::traced;
    }
    [[nodiscard]] std::uint32_t chain_of(Edge e) const { return graph_.chain_of[e.arc]; }
    void update(std::uint32_t arc);
    void keep(std::uint32_t arc);
    [[nodiscard]] bool joined(Edge e, Edge f) const;
    [[nodiscard]] bool conflict(Edge e, const FineSegment& s, Edge f, const FineSegment& t) const;
    void check_arc(std::uint32_t arc, Conflicts& found);
    void check_nodes(Conflicts& found);
    void check_node(std::uint32_t node, Conflicts& found);
    /// The westernmost vertex of a part, the lowest of these on the map.
    struct West {
        FinePoint at{0, std::numeric_limits<std::int64_t>::max()};
        std::uint32_t arc = 0;
        std::uint32_t index = 0;
    };
    void find_west();
    [[nodiscard]] std::int32_t outer_side(const West& w) const;
    void check_parts(Conflicts& found);
    /// The point to which an arc leads from the node at one of its ends.
    [[nodiscard]] FinePoint next_from(std::uint32_t arc_end) const;
    [[nodiscard]] std::int32_t side_after(std::uint32_t arc_end) const;
    [[nodiscard]] std::int32_t side_before(std::uint32_t arc_end) const;
    /// The edge that is hit first on the way west; its side towards the place.
    [[nodiscard]] std::pair<std::uint32_t, std::int32_t> west_of(FinePoint place) const;
    [[nodiscard]] bool alone(FinePoint place, std::uint32_t part) const;

    const WallGraph& graph_;
    const WallDrawing& drawing_;
    const SegmentGrid::Arcs& arcs_;
    SegmentGrid grid_;
    double tolerance_;
    const StopRequest& stop_;
    std::vector<std::uint8_t> changed_;      // arcs, this time
    std::vector<std::uint8_t> as_traced_;    // arcs
    std::vector<std::uint8_t> in_conflict_;  // arcs, since they were tested last
    std::vector<std::uint32_t> conflicting_;
    std::vector<std::uint32_t> tested_;     // arcs, this time
    std::vector<std::uint8_t> node_waits_;  // to be checked
    std::vector<std::uint32_t> waiting_nodes_;
    std::vector<std::uint32_t> ends_;       // at a node, in order
    std::vector<std::uint32_t> part_arcs_;  // arcs, those of one part after the other
    std::vector<std::uint32_t> first_of_part_;
    std::vector<std::uint8_t> part_waits_;  // has changed since its westernmost vertex was found
    std::vector<West> west_;                // of each part
};

}  // namespace d2b
