#include "outline/walls/wall_check.hpp"

#include <algorithm>
#include <utility>

namespace d2b {
namespace {

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

WallCheck::WallCheck(const WallGraph& graph, const SegmentGrid::Arcs& arcs, double tolerance,
                     const StopRequest& stop)
    : graph_(graph),
      arcs_(arcs),
      grid_(arcs, box_of(graph.graph, tolerance), edges_of(graph.graph)),
      stop_(stop),
      changed_(arcs.size()),
      in_conflict_(arcs.size()),
      node_waits_(graph.nodes.size()),
      parts_(graph, arcs, grid_, tolerance, stop) {}

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
        parts_.check(found);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void WallCheck::update(std::uint32_t arc) {
    grid_.update(arc);
    changed_[arc] = 1;
    tested_.push_back(arc);
    parts_.changed(graph_.part_of[graph_.chain_of[arc]]);
    for (const std::uint32_t node : graph_.ends[arc])
        if (std::exchange(node_waits_[node], std::uint8_t{1}) == 0)
            waiting_nodes_.push_back(node);
}

/// Marks an arc to be tested again even if it does not change.
void WallCheck::keep(std::uint32_t arc) {
    if (std::exchange(in_conflict_[arc], std::uint8_t{1}) == 0)
        conflicting_.push_back(arc);
}

/// Returns true if two edges may share their common point: neighbours within an arc, or edges at a node.
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

bool WallCheck::conflict(Edge e, const FineSegment& s, Edge f, const FineSegment& t) const {
    if (e.arc == f.arc && e.index + 1 == f.index)
        return overlap_from(s.b, s.a, t.b);  // the most frequent case
    if (!meet(s, t))
        return false;
    const int shared =
        (s.a == t.a ? 1 : 0) + (s.a == t.b ? 1 : 0) + (s.b == t.a ? 1 : 0) + (s.b == t.b ? 1 : 0);
    if (shared != 1 || s.a == s.b || t.a == t.b || !joined(e, f))
        return true;
    const FinePoint common = s.a == t.a || s.a == t.b ? s.a : s.b;
    return overlap_from(common, s.a == common ? s.b : s.a, t.a == common ? t.b : t.a);
}

void WallCheck::check_arc(std::uint32_t arc, WallConflicts& found) {
    for (std::uint32_t i = 0; i + 1 < arcs_[arc].size(); ++i) {
        stop_.check();
        const Edge e{arc, i};
        const FineSegment s = grid_.segment(e);
        if (s.a == s.b) {
            found.emplace_back(e, e);
            keep(arc);
        }
        grid_.near(s, [&](Edge f) {
            // A pair of changed arcs is tested once, by the first of the two.
            if (f.arc == arc ? f.index <= i : changed_[f.arc] != 0 && f.arc < arc)
                return;
            const FineSegment t = grid_.segment(f);
            if (!conflict(e, s, f, t))
                return;
            found.emplace_back(std::minmax(e, f));
            keep(arc);
            keep(f.arc);
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
    std::erase_if(waiting_nodes_, [&](std::uint32_t node) {
        const std::size_t before = found.size();
        check_node(node, found);
        if (found.size() == before)
            node_waits_[node] = 0;
        return found.size() == before;
    });
}

void WallCheck::check_node(std::uint32_t node, WallConflicts& found) {
    const auto ends = graph_.ends_at(node);
    ends_.assign(ends.begin(), ends.end());
    const auto& first = arcs_[ends_.front() / 2];
    const FinePoint at = ends_.front() % 2 == 0 ? first.front() : first.back();
    std::sort(ends_.begin(), ends_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return earlier_from_west(at, next_from(arcs_, a), next_from(arcs_, b));
    });
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        const std::uint32_t next = ends_[i + 1 < ends_.size() ? i + 1 : 0];
        if (graph_.side_after(ends_[i]) != graph_.side_before(next))
            found.emplace_back(std::minmax(edge_at(ends_[i]), edge_at(next)));
    }
}

}  // namespace d2b
