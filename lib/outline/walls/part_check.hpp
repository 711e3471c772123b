#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/segment_grid.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Pairs of conflicting edges; an edge may conflict with itself.
using WallConflicts = std::vector<std::pair<SegmentGrid::Edge, SegmentGrid::Edge>>;

/// Point next to the node at an arc end (2 * arc, or 2 * arc + 1 for the last point).
[[nodiscard]] inline FinePoint next_from(const SegmentGrid::Arcs& arcs, std::uint32_t end) {
    const auto& points = arcs[end / 2];
    return end % 2 == 0 ? points[1] : points[points.size() - 2];
}

/// Tests that every connected component of a drawn graph lies in the contour in which it was traced. Exact if
/// the drawn edges do not cross.
class PartCheck {
  public:
    /// @param arcs as drawn, in `grid` @param tolerance largest distance in cells between an arc and its
    /// trace
    /// @param stop must outlive this, as must the others
    PartCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, const SegmentGrid& grid,
              double tolerance, const StopRequest& stop);

    void changed(std::uint32_t part) { part_waits_[part] = 1; }
    void check(WallConflicts& found);
    [[nodiscard]] std::span<const std::uint32_t> arcs_of(std::uint32_t part) const {
        return std::span(part_arcs_)
            .subspan(first_of_part_[part], first_of_part_[part + 1] - first_of_part_[part]);
    }

  private:
    using Edge = SegmentGrid::Edge;

    [[nodiscard]] std::uint32_t chain_of(Edge e) const { return graph_.chain_of[e.arc]; }
    /// Westernmost vertex of a component; the lowest on the map if there are several.
    struct West {
        FinePoint at{0, std::numeric_limits<std::int64_t>::max()};
        std::uint32_t arc = 0;
        std::uint32_t index = 0;
    };
    void find_west();
    [[nodiscard]] std::int32_t outer_side(const West& w) const;
    /// First edge hit by a ray from a point to the west, and the contour on the side that faces the point.
    [[nodiscard]] std::pair<std::optional<Edge>, std::int32_t> west_of(FinePoint place) const;
    [[nodiscard]] bool alone(FinePoint place, std::uint32_t part) const;

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    const SegmentGrid& grid_;
    double tolerance_;
    const StopRequest& stop_;
    std::vector<std::uint32_t> part_arcs_;  // arcs grouped by component
    std::vector<std::uint32_t> first_of_part_;
    std::vector<std::uint8_t> part_waits_;  // changed since its westernmost vertex was found
    std::vector<West> west_;                // per component
};

}  // namespace d2b
