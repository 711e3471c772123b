#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "outline/segment_grid.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b::outline {

/// Pairs of conflicting edges; an edge may conflict with itself.
using WallConflicts = std::vector<std::pair<SegmentGrid::Edge, SegmentGrid::Edge>>;

/// Point next to the node at an arc end (2 * arc, or 2 * arc + 1 for the last point).
[[nodiscard]] inline FinePoint next_from(const SegmentGrid::Arcs& arcs, std::uint32_t end) {
    const auto& points = arcs[end / 2];
    return end % 2 == 0 ? points[1] : points[points.size() - 2];
}

/// Tests that every connected component of a drawn graph lies in the contour in which it was traced. Exact if
/// the drawn edges do not cross.
class ContainmentCheck {
  public:
    /// @param arcs as drawn, in `grid` @param tolerance largest distance in cells between an arc and its
    /// trace
    /// @param stop must outlive this, as must the others
    ContainmentCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, const SegmentGrid& grid,
                     double tolerance, const StopToken& stop);

    void changed(std::uint32_t component) { component_changed_[component] = 1; }
    void check(WallConflicts& found);

  private:
    using Edge = SegmentGrid::Edge;

    [[nodiscard]] std::uint32_t chain_of(Edge e) const { return graph_.chain_of[e.arc]; }
    /// Westernmost vertex of a component; the lowest on the map if there are several.
    struct Westernmost {
        FinePoint at{0, std::numeric_limits<std::int64_t>::max()};
        std::uint32_t arc = 0;
        std::uint32_t index = 0;
    };
    void find_westernmost();
    [[nodiscard]] std::int32_t outer_side(const Westernmost& w) const;
    /// First edge hit by a ray from a point to the west, and the contour on the side that faces the point.
    [[nodiscard]] std::pair<std::optional<Edge>, std::int32_t> first_edge_west_of(FinePoint place) const;
    [[nodiscard]] bool is_isolated(FinePoint place, std::uint32_t component) const;

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    const SegmentGrid& grid_;
    double tolerance_;
    const StopToken& stop_;
    std::vector<std::uint8_t> component_changed_;  // changed since its westernmost vertex was found
    std::vector<Westernmost> westernmost_;         // per component
};

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
    WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance, const StopToken& stop);

    /// True if an arc must be reported even if unchanged, because it was in conflict.
    [[nodiscard]] bool was_in_conflict(std::uint32_t arc) const { return in_conflict_[arc] != 0; }
    /// Updates redrawn arcs and tests them together with those previously in conflict.
    /// @param changed sorted
    /// @return sorted @throws Cancelled
    [[nodiscard]] WallConflicts conflicts(const std::vector<std::uint32_t>& changed);

  private:
    using Edge = SegmentGrid::Edge;

    void update(std::uint32_t arc);
    void mark_conflicting(std::uint32_t arc);
    [[nodiscard]] bool share_node(Edge e, Edge f) const;
    [[nodiscard]] bool conflict(Edge e, const FineSegment& s, Edge f, const FineSegment& t) const;
    void check_arc(std::uint32_t arc, WallConflicts& found);
    [[nodiscard]] Edge edge_at(std::uint32_t end) const;
    void check_nodes(WallConflicts& found);
    void check_node(std::uint32_t node, WallConflicts& found);

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    SegmentGrid grid_;
    const StopToken& stop_;
    std::vector<std::uint8_t> changed_;      // per arc, in this call
    std::vector<std::uint8_t> in_conflict_;  // per arc, since its last test
    std::vector<std::uint32_t> conflicting_;
    std::vector<std::uint32_t> tested_;       // arcs tested in this call
    std::vector<std::uint8_t> node_pending_;  // per node: has yet to be checked
    std::vector<std::uint32_t> pending_nodes_;
    std::vector<std::uint32_t> ends_;  // arc ends at a node, in angular order
    ContainmentCheck containment_;
};

}  // namespace d2b::outline
