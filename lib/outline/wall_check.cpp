#include "outline/wall_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace d2b {
namespace {

/// Of two edges that run down over one row and do not cross, whether the first lies east.
bool east_of(const FineSegment& a, const FineSegment& b) {
    const int above = a.a.row >= b.a.row ? sign(turn(b.a, b.b, a.a)) : -sign(turn(a.a, a.b, b.a));
    const int below = a.b.row <= b.b.row ? sign(turn(b.a, b.b, a.b)) : -sign(turn(a.a, a.b, b.b));
    return above + below > 0;
}

}  // namespace

WallCheck::Conflicts WallCheck::conflicts(const std::vector<bool>& parts) const {
    Conflicts found;
    check_edges(parts, found);
    // The other two tests rest on this one.
    if (found.empty()) {
        check_nodes(parts, found);
        check_parts(found);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Whether two edges may have their common point in common: neighbours in an arc, or first at a node.
bool WallCheck::joined(Edge e, Edge f) const {
    const FineSegment s = grid_.segment(e);
    const FineSegment t = grid_.segment(f);
    if (e.arc == f.arc && (e.index + 1 == f.index || f.index + 1 == e.index))
        return true;
    const auto node_at = [&](Edge edge, FinePoint p) {
        const auto& points = arcs_[edge.arc];
        if (edge.index == 0 && points.front() == p)
            return graph_.ends[edge.arc][0];
        if (edge.index + 2 == points.size() && points.back() == p)
            return graph_.ends[edge.arc][1];
        return WallGraph::nobody;
    };
    const FinePoint common = s.a == t.a || s.a == t.b ? s.a : s.b;
    const std::uint32_t node = node_at(e, common);
    return node != WallGraph::nobody && node == node_at(f, common);
}

bool WallCheck::in_conflict(Edge e, Edge f) const {
    const FineSegment s = grid_.segment(e);
    const FineSegment t = grid_.segment(f);
    if (!meet(s, t))
        return false;
    const int shared =
        (s.a == t.a ? 1 : 0) + (s.a == t.b ? 1 : 0) + (s.b == t.a ? 1 : 0) + (s.b == t.b ? 1 : 0);
    if (shared != 1 || s.a == s.b || t.a == t.b || !joined(e, f))
        return true;
    const FinePoint common = s.a == t.a || s.a == t.b ? s.a : s.b;
    return overlap_from(common, s.a == common ? s.b : s.a, t.a == common ? t.b : t.a);
}

void WallCheck::check_edges(const std::vector<bool>& parts, Conflicts& found) const {
    const auto changed = [&](Edge e) { return parts[graph_.part_of[chain_of(e)]]; };
    for (std::uint32_t arc = 0; arc < arcs_.size(); ++arc)
        for (std::size_t i = 0; i + 1 < arcs_[arc].size(); ++i)
            if (arcs_[arc][i] == arcs_[arc][i + 1])
                found.emplace_back(graph_.chain_of[arc], graph_.chain_of[arc]);
    grid_.for_each_bucket([&](std::span<const SegmentGrid::Entry> bucket) {
        for (std::size_t i = 0; i < bucket.size(); ++i)
            for (std::size_t k = i + 1; k < bucket.size(); ++k) {
                const Edge e = bucket[i].edge;
                const Edge f = bucket[k].edge;
                if ((changed(e) || changed(f)) && in_conflict(e, f))
                    found.emplace_back(std::minmax(chain_of(e), chain_of(f)));
            }
    });
}

FinePoint WallCheck::next_from(std::uint32_t end) const {
    const auto& points = arcs_[end / 2];
    return end % 2 == 0 ? points[1] : points[points.size() - 2];
}

/// The contour beside an arc that leaves a node, on its counter-clockwise side: its left.
std::int64_t WallCheck::side_after(std::uint32_t end) const {
    return end % 2 == 0 ? graph_.sides[end / 2].left : graph_.sides[end / 2].right;
}
std::int64_t WallCheck::side_before(std::uint32_t end) const {
    return end % 2 == 0 ? graph_.sides[end / 2].right : graph_.sides[end / 2].left;
}

void WallCheck::check_nodes(const std::vector<bool>& parts, Conflicts& found) const {
    std::vector<std::uint32_t> ends;
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
        ends.assign(graph_.arc_ends.begin() + graph_.first_end[n],
                    graph_.arc_ends.begin() + graph_.first_end[n + 1]);
        if (!parts[graph_.part_of[graph_.chain_of[ends.front() / 2]]])
            continue;
        const auto& first = arcs_[ends.front() / 2];
        const FinePoint at = ends.front() % 2 == 0 ? first.front() : first.back();
        std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
            return earlier_from_west(at, next_from(a), next_from(b));
        });
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const std::uint32_t next = ends[(i + 1) % ends.size()];
            if (side_after(ends[i]) != side_before(next))
                found.emplace_back(std::minmax(graph_.chain_of[ends[i] / 2], graph_.chain_of[next / 2]));
        }
    }
}

/// Whether no arc of another part is so near that a part could have come to its other side.
bool WallCheck::alone(FinePoint place, std::uint32_t part) const {
    const auto reach = static_cast<std::int64_t>(std::ceil(4 * tolerance_ + 2)) * FinePoint::steps;
    for (std::int64_t row = SegmentGrid::bucket_of(place.row - reach);
         row <= SegmentGrid::bucket_of(place.row + reach); ++row)
        for (std::int64_t col = SegmentGrid::bucket_of(place.col - reach);
             col <= SegmentGrid::bucket_of(place.col + reach); ++col)
            for (const SegmentGrid::Entry& entry : grid_.at(row, col))
                if (graph_.part_of[chain_of(entry.edge)] != part)
                    return false;
    return true;
}

std::pair<std::uint32_t, std::int64_t> WallCheck::west_of(FinePoint place) const {
    const std::int64_t row = SegmentGrid::bucket_of(place.row);
    std::optional<Edge> nearest;
    FineSegment best;  // downwards
    for (std::int64_t col = SegmentGrid::bucket_of(place.col); col >= grid_.first_col(); --col) {
        for (const SegmentGrid::Entry& entry : grid_.at(row, col)) {
            const FineSegment s = grid_.segment(entry.edge);
            // Edges that cross the line just below the place's row, west of it.
            if ((s.a.row <= place.row) == (s.b.row <= place.row))
                continue;
            const FineSegment down = s.a.row <= place.row ? s : FineSegment{s.b, s.a};
            if (turn(down.a, down.b, place) > 0 && (!nearest || east_of(down, best))) {
                nearest = entry.edge;
                best = down;
            }
        }
        // It may cross farther west than this bucket.
        if (nearest && turn(best.a, best.b, {place.row, SegmentGrid::first_of(col)}) <= 0)
            break;
    }
    if (!nearest)
        return {WallGraph::nobody, -1};
    // East of an edge that runs down is its left.
    const WallGraph::Sides& sides = graph_.sides[nearest->arc];
    return {chain_of(*nearest), grid_.segment(*nearest).a == best.a ? sides.left : sides.right};
}

std::vector<WallCheck::West> WallCheck::west_of_parts() const {
    std::vector<West> west(graph_.parts);
    for (std::uint32_t arc = 0; arc < arcs_.size(); ++arc)
        for (std::uint32_t i = 0; i < arcs_[arc].size(); ++i) {
            West& w = west[graph_.part_of[graph_.chain_of[arc]]];
            const FinePoint p = arcs_[arc][i];
            if (p.col < w.at.col || (p.col == w.at.col && p.row > w.at.row))
                w = {p, arc, i};
        }
    return west;
}

/// As one turns from west counter-clockwise, the first edge is met from the side that looks outwards.
std::int64_t WallCheck::outer_side(const West& w) const {
    const auto& points = arcs_[w.arc];
    if (w.index > 0 && w.index + 1 < points.size()) {
        const bool forward = earlier_from_west(w.at, points[w.index + 1], points[w.index - 1]);
        return forward ? graph_.sides[w.arc].right : graph_.sides[w.arc].left;
    }
    const std::uint32_t node = graph_.ends[w.arc][w.index == 0 ? 0 : 1];
    std::uint32_t first = graph_.arc_ends[graph_.first_end[node]];
    for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
        if (earlier_from_west(w.at, next_from(graph_.arc_ends[e]), next_from(first)))
            first = graph_.arc_ends[e];
    return side_before(first);
}

void WallCheck::check_parts(Conflicts& found) const {
    const std::vector<West> west = west_of_parts();
    for (std::uint32_t part = 0; part < graph_.parts; ++part) {
        const West& w = west[part];
        if (alone(w.at, part))
            continue;
        const auto [chain, side] = west_of(w.at);
        if (side == outer_side(w))
            continue;
        const std::uint32_t own = graph_.chain_of[w.arc];
        found.emplace_back(std::minmax(own, chain == WallGraph::nobody ? own : chain));
    }
}

}  // namespace d2b
