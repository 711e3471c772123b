#include "outline/walls/wall_check.hpp"

#include <algorithm>
#include <cmath>

namespace d2b::outline {
namespace {

/// Returns true if edge a lies east of edge b. Both run downwards across a common row and do not cross.
bool east_of(const FineSegment& a, const FineSegment& b) {
    const int above =
        a.from.row >= b.from.row ? sign(turn(b.from, b.to, a.from)) : -sign(turn(a.from, a.to, b.from));
    const int below = a.to.row <= b.to.row ? sign(turn(b.from, b.to, a.to)) : -sign(turn(a.from, a.to, b.to));
    return above + below > 0;
}

LatticeBox box_of(const ArcGraph& graph, double margin) {
    LatticeBox box{graph.arcs.front().front(), graph.arcs.front().front()};
    for (const Arc& arc : graph.arcs)
        for (const LatticePoint p : arc) {
            box.low = {std::min(box.low.row, p.row), std::min(box.low.col, p.col)};
            box.high = {std::max(box.high.row, p.row), std::max(box.high.col, p.col)};
        }
    const auto cells = static_cast<std::int32_t>(margin) + 1;
    return {{box.low.row - cells, box.low.col - cells}, {box.high.row + cells, box.high.col + cells}};
}

std::size_t edges_of(const ArcGraph& graph) {
    std::size_t sum = 0;
    for (const Arc& arc : graph.arcs)
        sum += arc.size() - 1;
    return sum;
}

}  // namespace

ContainmentCheck::ContainmentCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs,
                                   const SegmentGrid& grid, double tolerance, const StopToken& stop)
    : graph_(graph),
      arcs_(arcs),
      grid_(grid),
      tolerance_(tolerance),
      stop_(stop),
      component_changed_(graph.arcs_of.size(), 1),
      westernmost_(graph.arcs_of.size()) {}

/// Returns true if no arc of another component is so near that the component could have moved to its other
/// side.
bool ContainmentCheck::is_isolated(FinePoint place, std::uint32_t component) const {
    const auto reach = static_cast<std::int64_t>(std::ceil(4 * tolerance_ + 2)) * FinePoint::steps;
    bool others = false;
    for (std::int64_t row = grid_.row_of(place.row - reach); row <= grid_.row_of(place.row + reach); ++row)
        for (std::int64_t col = grid_.col_of(place.col - reach);
             col <= grid_.col_of(place.col + reach) && !others; ++col)
            grid_.visit_bucket(
                row, col, [&](Edge e) { others = others || graph_.component_of[chain_of(e)] != component; });
    return !others;
}

std::pair<std::optional<ContainmentCheck::Edge>, std::int32_t> ContainmentCheck::first_edge_west_of(
    FinePoint place) const {
    const std::int64_t row = grid_.row_of(place.row);
    std::optional<Edge> nearest;
    FineSegment best;  // oriented downwards
    for (std::int64_t col = grid_.col_of(place.col); col >= 0; --col) {
        grid_.visit_bucket(row, col, [&](Edge edge) {
            const FineSegment s = grid_.segment(edge);
            // Edges that cross the line just below the row of the point, west of it.
            if ((s.from.row <= place.row) == (s.to.row <= place.row))
                return;
            const FineSegment down = s.from.row <= place.row ? s : FineSegment{s.to, s.from};
            if (turn(down.from, down.to, place) > 0 && (!nearest || east_of(down, best))) {
                nearest = edge;
                best = down;
            }
        });
        // The edge may cross the row farther west than this bucket.
        if (nearest && turn(best.from, best.to, {place.row, grid_.bucket_start(col)}) <= 0)
            break;
    }
    if (!nearest)
        return {{}, -1};
    // East of a downward edge is its left side.
    const WallGraph::Sides& sides = graph_.sides[nearest->arc];
    return {nearest, grid_.segment(*nearest).from == best.from ? sides.left : sides.right};
}

void ContainmentCheck::find_westernmost() {
    for (std::uint32_t component = 0; component < graph_.arcs_of.size(); ++component) {
        if (std::exchange(component_changed_[component], std::uint8_t{0}) == 0)
            continue;
        Westernmost& w = westernmost_[component] = {};
        for (const std::uint32_t arc : graph_.arcs_of[component])
            for (std::uint32_t i = 0; i < arcs_[arc].size(); ++i) {
                const FinePoint p = arcs_[arc][i];
                if (p.col < w.at.col || (p.col == w.at.col && p.row > w.at.row))
                    w = {p, arc, i};
            }
    }
}

/// Turning counter-clockwise from west, the first edge is met on its outer side.
std::int32_t ContainmentCheck::outer_side(const Westernmost& w) const {
    const auto& points = arcs_[w.arc];
    if (w.index > 0 && w.index + 1 < points.size()) {
        const bool forward = precedes_ccw(w.at, points[w.index + 1], points[w.index - 1]);
        return forward ? graph_.sides[w.arc].right : graph_.sides[w.arc].left;
    }
    const std::uint32_t node = graph_.ends[w.arc][w.index == 0 ? 0 : 1];
    std::uint32_t first = graph_.ends_at[node].front();
    for (const std::uint32_t end : graph_.ends_at[node])
        if (precedes_ccw(w.at, next_from(arcs_, end), next_from(arcs_, first)))
            first = end;
    return graph_.side_before(first);
}

void ContainmentCheck::check(WallConflicts& found) {
    if (graph_.arcs_of.size() == 1)
        return;  // it cannot lie in another component
    find_westernmost();
    for (std::uint32_t component = 0; component < graph_.arcs_of.size(); ++component) {
        stop_.check();
        const Westernmost& w = westernmost_[component];
        if (is_isolated(w.at, component))
            continue;
        const auto [edge, side] = first_edge_west_of(w.at);
        if (side == outer_side(w))
            continue;
        const Edge own{w.arc, w.index > 0 ? w.index - 1 : 0};
        found.emplace_back(std::minmax(own, edge.value_or(own)));
    }
}

WallCheck::WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance,
                     const StopToken& stop)
    : graph_(graph),
      arcs_(arcs),
      grid_(arcs, box_of(graph.graph, tolerance), edges_of(graph.graph)),
      stop_(stop),
      changed_(arcs.size()),
      in_conflict_(arcs.size()),
      node_pending_(graph.nodes.size()),
      containment_(graph, arcs, grid_, tolerance, stop) {}

WallConflicts WallCheck::conflicts(const std::vector<std::uint32_t>& changed) {
    tested_.clear();
    for (const std::uint32_t arc : changed) {
        stop_.check();
        update(arc);
    }
    for (const std::uint32_t arc : conflicting_) {
        in_conflict_[arc] = 0;
        if (std::exchange(changed_[arc], std::uint8_t{1}) == 0)
            tested_.push_back(arc);
    }
    conflicting_.clear();
    WallConflicts found;
    for (const std::uint32_t arc : tested_)
        check_arc(arc, found);
    for (const std::uint32_t arc : tested_)
        changed_[arc] = 0;
    // The other two tests require edges that do not cross.
    if (found.empty()) {
        check_nodes(found);
        containment_.check(found);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void WallCheck::update(std::uint32_t arc) {
    grid_.update(arc);
    changed_[arc] = 1;
    tested_.push_back(arc);
    containment_.changed(graph_.component_of[graph_.chain_of[arc]]);
    for (const std::uint32_t node : graph_.ends[arc])
        if (std::exchange(node_pending_[node], std::uint8_t{1}) == 0)
            pending_nodes_.push_back(node);
}

/// Marks an arc to be tested again even if it does not change.
void WallCheck::mark_conflicting(std::uint32_t arc) {
    if (std::exchange(in_conflict_[arc], std::uint8_t{1}) == 0)
        conflicting_.push_back(arc);
}

/// Returns true if two edges may share their common point: neighbours within an arc, or edges at a node.
bool WallCheck::share_node(Edge e, Edge f) const {
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
        return WallGraph::none;
    };
    const FinePoint common = s.from == t.from || s.from == t.to ? s.from : s.to;
    const std::uint32_t node = node_at(e, common);
    return node != WallGraph::none && node == node_at(f, common);
}

bool WallCheck::conflict(Edge e, const FineSegment& s, Edge f, const FineSegment& t) const {
    if (e.arc == f.arc && e.index + 1 == f.index)
        return overlap_from(s.to, s.from, t.to);  // the most frequent case
    if (!segments_intersect(s, t))
        return false;
    const int shared = (s.from == t.from ? 1 : 0) + (s.from == t.to ? 1 : 0) + (s.to == t.from ? 1 : 0) +
                       (s.to == t.to ? 1 : 0);
    if (shared != 1 || s.from == s.to || t.from == t.to || !share_node(e, f))
        return true;
    const FinePoint common = s.from == t.from || s.from == t.to ? s.from : s.to;
    return overlap_from(common, s.from == common ? s.to : s.from, t.from == common ? t.to : t.from);
}

void WallCheck::check_arc(std::uint32_t arc, WallConflicts& found) {
    for (std::uint32_t i = 0; i + 1 < arcs_[arc].size(); ++i) {
        stop_.check();
        const Edge e{arc, i};
        const FineSegment s = grid_.segment(e);
        if (s.from == s.to) {
            found.emplace_back(e, e);
            mark_conflicting(arc);
        }
        grid_.near(s, [&](Edge f) {
            // A pair of changed arcs is tested once, by the first of the two.
            if (f.arc == arc ? f.index <= i : changed_[f.arc] != 0 && f.arc < arc)
                return;
            const FineSegment t = grid_.segment(f);
            if (!conflict(e, s, f, t))
                return;
            found.emplace_back(std::minmax(e, f));
            mark_conflicting(arc);
            mark_conflicting(f.arc);
        });
    }
}

/// Edge at an arc end.
WallCheck::Edge WallCheck::edge_at(std::uint32_t end) const {
    const auto points = static_cast<std::uint32_t>(arcs_[end / 2].size());
    return {end / 2, end % 2 == 0 ? 0 : points - 2};
}

/// Nodes with an invalid order of arcs remain pending.
void WallCheck::check_nodes(WallConflicts& found) {
    std::erase_if(pending_nodes_, [&](std::uint32_t node) {
        const std::size_t before = found.size();
        check_node(node, found);
        if (found.size() == before)
            node_pending_[node] = 0;
        return found.size() == before;
    });
}

void WallCheck::check_node(std::uint32_t node, WallConflicts& found) {
    const auto ends = graph_.ends_at[node];
    ends_.assign(ends.begin(), ends.end());
    const auto& first = arcs_[ends_.front() / 2];
    const FinePoint at = ends_.front() % 2 == 0 ? first.front() : first.back();
    std::sort(ends_.begin(), ends_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return precedes_ccw(at, next_from(arcs_, a), next_from(arcs_, b));
    });
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        const std::uint32_t next = ends_[i + 1 < ends_.size() ? i + 1 : 0];
        if (graph_.side_after(ends_[i]) != graph_.side_before(next))
            found.emplace_back(std::minmax(edge_at(ends_[i]), edge_at(next)));
    }
}

}  // namespace d2b::outline
