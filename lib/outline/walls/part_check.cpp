#include "outline/walls/part_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace d2b {
namespace {

/// Returns true if edge a lies east of edge b. Both run downwards across a common row and do not cross.
bool east_of(const FineSegment& a, const FineSegment& b) {
    const int above = a.a.row >= b.a.row ? sign(turn(b.a, b.b, a.a)) : -sign(turn(a.a, a.b, b.a));
    const int below = a.b.row <= b.b.row ? sign(turn(b.a, b.b, a.b)) : -sign(turn(a.a, a.b, b.b));
    return above + below > 0;
}

}  // namespace

PartCheck::PartCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, const SegmentGrid& grid,
                     double tolerance, const StopRequest& stop)
    : graph_(graph),
      arcs_(arcs),
      grid_(grid),
      tolerance_(tolerance),
      stop_(stop),
      first_of_part_(graph.parts + 1),
      part_waits_(graph.parts, 1),
      west_(graph.parts) {
    const auto part = [&](std::uint32_t arc) { return graph_.part_of[graph_.chain_of[arc]]; };
    for (std::uint32_t arc = 0; arc < arcs.size(); ++arc)
        ++first_of_part_[part(arc) + 1];
    for (std::uint32_t p = 0; p < graph.parts; ++p)
        first_of_part_[p + 1] += first_of_part_[p];
    part_arcs_.resize(arcs.size());
    std::vector<std::uint32_t> next = first_of_part_;
    for (std::uint32_t arc = 0; arc < arcs.size(); ++arc)
        part_arcs_[next[part(arc)]++] = arc;
}

/// Returns true if no arc of another component is so near that the component could have moved to its other
/// side.
bool PartCheck::alone(FinePoint place, std::uint32_t part) const {
    const auto reach = static_cast<std::int64_t>(std::ceil(4 * tolerance_ + 2)) * FinePoint::steps;
    bool others = false;
    for (std::int64_t row = grid_.row_of(place.row - reach); row <= grid_.row_of(place.row + reach); ++row)
        for (std::int64_t col = grid_.col_of(place.col - reach);
             col <= grid_.col_of(place.col + reach) && !others; ++col)
            grid_.in_bucket(row, col,
                            [&](Edge e) { others = others || graph_.part_of[chain_of(e)] != part; });
    return !others;
}

std::pair<std::optional<PartCheck::Edge>, std::int32_t> PartCheck::west_of(FinePoint place) const {
    const std::int64_t row = grid_.row_of(place.row);
    std::optional<Edge> nearest;
    FineSegment best;  // oriented downwards
    for (std::int64_t col = grid_.col_of(place.col); col >= 0; --col) {
        grid_.in_bucket(row, col, [&](Edge edge) {
            const FineSegment s = grid_.segment(edge);
            // Edges that cross the line just below the row of the point, west of it.
            if ((s.a.row <= place.row) == (s.b.row <= place.row))
                return;
            const FineSegment down = s.a.row <= place.row ? s : FineSegment{s.b, s.a};
            if (turn(down.a, down.b, place) > 0 && (!nearest || east_of(down, best))) {
                nearest = edge;
                best = down;
            }
        });
        // The edge may cross the row farther west than this bucket.
        if (nearest && turn(best.a, best.b, {place.row, grid_.first_of(col)}) <= 0)
            break;
    }
    if (!nearest)
        return {{}, -1};
    // East of a downward edge is its left side.
    const WallGraph::Sides& sides = graph_.sides[nearest->arc];
    return {nearest, grid_.segment(*nearest).a == best.a ? sides.left : sides.right};
}

void PartCheck::find_west() {
    for (std::uint32_t part = 0; part < graph_.parts; ++part) {
        if (std::exchange(part_waits_[part], std::uint8_t{0}) == 0)
            continue;
        West& w = west_[part] = {};
        for (std::uint32_t k = first_of_part_[part]; k < first_of_part_[part + 1]; ++k) {
            const std::uint32_t arc = part_arcs_[k];
            for (std::uint32_t i = 0; i < arcs_[arc].size(); ++i) {
                const FinePoint p = arcs_[arc][i];
                if (p.col < w.at.col || (p.col == w.at.col && p.row > w.at.row))
                    w = {p, arc, i};
            }
        }
    }
}

/// Turning counter-clockwise from west, the first edge is met on its outer side.
std::int32_t PartCheck::outer_side(const West& w) const {
    const auto& points = arcs_[w.arc];
    if (w.index > 0 && w.index + 1 < points.size()) {
        const bool forward = earlier_from_west(w.at, points[w.index + 1], points[w.index - 1]);
        return forward ? graph_.sides[w.arc].right : graph_.sides[w.arc].left;
    }
    const std::uint32_t node = graph_.ends[w.arc][w.index == 0 ? 0 : 1];
    std::uint32_t first = graph_.ends_at(node).front();
    for (const std::uint32_t end : graph_.ends_at(node))
        if (earlier_from_west(w.at, next_from(arcs_, end), next_from(arcs_, first)))
            first = end;
    return graph_.side_before(first);
}

void PartCheck::check(WallConflicts& found) {
    if (graph_.parts == 1)
        return;  // it cannot lie in another component
    find_west();
    for (std::uint32_t part = 0; part < graph_.parts; ++part) {
        stop_.check();
        const West& w = west_[part];
        if (alone(w.at, part))
            continue;
        const auto [edge, side] = west_of(w.at);
        if (side == outer_side(w))
            continue;
        const Edge own{w.arc, w.index > 0 ? w.index - 1 : 0};
        found.emplace_back(std::minmax(own, edge.value_or(own)));
    }
}

}  // namespace d2b
