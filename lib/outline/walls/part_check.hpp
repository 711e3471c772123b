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

/// Pairs of edges that are in each other's way, or one with itself.
using WallConflicts = std::vector<std::pair<SegmentGrid::Edge, SegmentGrid::Edge>>;

/// The point to which an arc leads from the node at one of its ends: 2 * arc, and + 1 for its last.
[[nodiscard]] inline FinePoint next_from(const SegmentGrid::Arcs& arcs, std::uint32_t end) {
    const auto& points = arcs[end / 2];
    return end % 2 == 0 ? points[1] : points[points.size() - 2];
}

/// Tests that every connected part of a drawn graph lies in the contour in which it was traced. Exact, for
/// drawings whose edges do not cross.
class PartCheck {
  public:
    /// @param arcs as they are drawn, in `grid` @param tolerance cells: no arc has left its trace by more
    /// @param stop must outlive this, as the others
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
    /// The westernmost vertex of a part, the lowest of these on the map.
    struct West {
        FinePoint at{0, std::numeric_limits<std::int64_t>::max()};
        std::uint32_t arc = 0;
        std::uint32_t index = 0;
    };
    void find_west();
    [[nodiscard]] std::int32_t outer_side(const West& w) const;
    /// The edge that is hit first on the way west; its side towards the place.
    [[nodiscard]] std::pair<std::optional<Edge>, std::int32_t> west_of(FinePoint place) const;
    [[nodiscard]] bool alone(FinePoint place, std::uint32_t part) const;

    const WallGraph& graph_;
    const SegmentGrid::Arcs& arcs_;
    const SegmentGrid& grid_;
    double tolerance_;
    const StopRequest& stop_;
    std::vector<std::uint32_t> part_arcs_;  // arcs, those of one part after the other
    std::vector<std::uint32_t> first_of_part_;
    std::vector<std::uint8_t> part_waits_;  // has changed since its westernmost vertex was found
    std::vector<West> west_;                // of each part
};

}  // namespace d2b
