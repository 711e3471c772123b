#pragma once

#include <cstdint>
#include <limits>
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
class WallCheck {
  public:
    /// @param tolerance cells: no arc has left its trace by more
    WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance)
        : graph_(graph), arcs_(arcs), grid_(arcs), tolerance_(tolerance) {}

    /// Pairs of chains that are in each other's way, sorted. @param parts that have changed
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(
        const std::vector<bool>& parts) const;

  private:
    using Conflicts = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    using Edge = SegmentGrid::Edge;

    [[nodiscard]] std::uint32_t chain_of(Edge e) const { return graph_.chain_of[e.arc]; }
    [[nodiscard]] bool joined(Edge e, Edge f) const;
    [[nodiscard]] bool in_conflict(Edge e, Edge f) const;
    void check_edges(const std::vector<bool>& parts, Conflicts& found) const;
    void check_nodes(const std::vector<bool>& parts, Conflicts& found) const;
    /// The westernmost vertex of a part, the lowest of these on the map.
    struct West {
        FinePoint at{0, std::numeric_limits<std::int64_t>::max()};
        std::uint32_t arc = 0;
        std::uint32_t index = 0;
    };
    [[nodiscard]] std::vector<West> west_of_parts() const;
    [[nodiscard]] std::int64_t outer_side(const West& w) const;
    void check_parts(Conflicts& found) const;
    /// The point to which an arc leads from the node at one of its ends.
    [[nodiscard]] FinePoint next_from(std::uint32_t arc_end) const;
    [[nodiscard]] std::int64_t side_after(std::uint32_t arc_end) const;
    [[nodiscard]] std::int64_t side_before(std::uint32_t arc_end) const;
    /// The edge that is hit first on the way west; its side towards the place.
    [[nodiscard]] std::pair<std::uint32_t, std::int64_t> west_of(FinePoint place) const;
    [[nodiscard]] bool alone(FinePoint place, std::uint32_t part) const;

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    SegmentGrid grid_;
    double tolerance_;
};

}  // namespace d2b
