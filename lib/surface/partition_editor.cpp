#include "surface/partition_editor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "outline/fine_geometry.hpp"

namespace d2b::surface {
namespace {

struct Cols {
    double low = 0;
    double high = 0;
};

/// Returns the columns of a segment between two rows.
std::optional<Cols> cols_between(FinePoint a, FinePoint b, double low_row, double high_row) {
    if (b.row < a.row)
        std::swap(a, b);
    const auto from = static_cast<double>(a.row);
    const auto to = static_cast<double>(b.row);
    if (to < low_row || from > high_row)
        return std::nullopt;
    const auto at = [&](double row) {
        const double share = to > from ? std::clamp((row - from) / (to - from), 0.0, 1.0) : 0.0;
        return static_cast<double>(a.col) + share * static_cast<double>(b.col - a.col);
    };
    const double first = at(low_row);
    const double last = to > from ? at(high_row) : static_cast<double>(b.col);
    return Cols{std::min(first, last), std::max(first, last)};
}

}  // namespace

EdgeGrid::Range EdgeGrid::rows_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t more) {
    const auto [low, high] = std::minmax({a.row, b.row, c.row});
    return {cell(low - more), cell(high + more)};
}

std::optional<EdgeGrid::Range> EdgeGrid::cols_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t row,
                                                 std::int64_t more) {
    const auto low_row = static_cast<double>((row << bucket_bits) - more);
    const auto high_row = static_cast<double>(((row + 1) << bucket_bits) + more);
    std::optional<Cols> all;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (const auto cols = cols_between(from, to, low_row, high_row))
            all = all ? Cols{std::min(all->low, cols->low), std::max(all->high, cols->high)} : *cols;
    if (!all)
        return std::nullopt;
    return Range{cell(static_cast<std::int64_t>(std::floor(all->low)) - more),
                 cell(static_cast<std::int64_t>(std::ceil(all->high)) + more)};
}

void EdgeGrid::add(std::uint32_t edge, FinePoint a, FinePoint b) {
    const auto [first, last] = rows_of(a, b, b, 0);
    for (std::int64_t row = first; row <= last; ++row)
        if (const auto cols = cols_of(a, b, b, row, 0))
            for (std::int64_t col = cols->first; col <= cols->second; ++col)
                strips_[{row, col >> strip_bits}][static_cast<std::size_t>(col & strip_mask)].push_back(edge);
}

PartitionEditor::PartitionEditor(PlanarPartition plan)
    : nodes_(std::move(plan.nodes)), edges_(std::move(plan.edges)), at_node_(nodes_.size()) {
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        at_node_[edges_[e].from].push_back(e);
        at_node_[edges_[e].to].push_back(e);
        index(e);
    }
}

std::vector<IncidentEdge> PartitionEditor::at_node(std::uint32_t node) const {
    std::vector<IncidentEdge> arms;
    arms.reserve(at_node_[node].size());
    for (const std::uint32_t e : at_node_[node])
        arms.push_back(seen_from(node, e, edges_[e]));
    return arms;
}

std::vector<IncidentEdge> PartitionEditor::around(std::uint32_t node) const {
    std::vector<IncidentEdge> arms = at_node(node);
    sort_around(nodes_, node, arms);
    return arms;
}

std::optional<std::uint32_t> PartitionEditor::edge_between(std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t e : at_node_[a])
        if (other_end(e, a) == b)
            return e;
    return std::nullopt;
}

Int128 PartitionEditor::swept_by(std::uint32_t edge, std::uint32_t node, FinePoint place) const {
    const Int128 twice = outline::turn(nodes_[node], place, nodes_[other_end(edge, node)]);
    return twice < 0 ? -twice : twice;
}

Int128 PartitionEditor::swept(std::uint32_t node, FinePoint place) const {
    Int128 sum = 0;
    for (const std::uint32_t e : at_node_[node])
        sum += swept_by(e, node, place);
    return sum;
}

Int128 PartitionEditor::swept_outside(std::uint32_t node, FinePoint place) const {
    Int128 sum = 0;
    for (const std::uint32_t e : at_node_[node])
        if (edges_[e].left == open_ground || edges_[e].right == open_ground)
            sum += swept_by(e, node, place);
    return sum;
}

/// Returns true if a segment from a node to a place would share nothing with an edge except that node.
bool PartitionEditor::is_disjoint_from(std::uint32_t edge, std::uint32_t from, FinePoint to) const {
    const PartitionEdge& other = edges_[edge];
    for (const auto& [a, b] : {std::pair(other.from, other.to), std::pair(other.to, other.from)})
        if (a == from)
            return nodes_[b] == to || !outline::overlap_from(nodes_[a], to, nodes_[b]);
        else if (nodes_[a] == to)
            return b == from || !outline::overlap_from(to, nodes_[from], nodes_[b]);
    return !outline::segments_intersect({nodes_[other.from], nodes_[other.to]}, {nodes_[from], to});
}

/// Returns true if an edge can follow its moved end: it sweeps a triangle, which must contain no other node,
/// and nothing may cross its new course.
bool PartitionEditor::is_sweep_clear(std::uint32_t node, std::uint32_t into, std::uint32_t end) const {
    const FinePoint a = nodes_[node];
    const FinePoint b = nodes_[into];
    const FinePoint x = nodes_[end];
    return grid_.all_in_triangle(a, b, x, [&](std::uint32_t e) {
        if (!is_edge(e))
            return true;
        const PartitionEdge& edge = edges_[e];
        if (edge.from != node && edge.to != node && !is_disjoint_from(e, into, x))
            return false;
        return std::ranges::none_of(std::array{edge.from, edge.to}, [&](std::uint32_t other) {
            return other != node && other != into && other != end &&
                   outline::in_triangle(a, b, x, nodes_[other]);
        });
    });
}

void PartitionEditor::detach(std::uint32_t edge, std::uint32_t node) {
    std::erase(at_node_[node], edge);
}

void PartitionEditor::remove(std::uint32_t edge) {
    detach(edge, edges_[edge].from);
    detach(edge, edges_[edge].to);
    edges_[edge].to = edges_[edge].from;
}

/// Combines two edges between the same nodes, which removes the area between them.
bool PartitionEditor::combine(std::uint32_t gone, std::uint32_t stays, std::uint32_t from) {
    const IncidentEdge stay = seen_from(from, stays, edges_[stays]);
    // Seen from its far end, because its near end has not been moved yet.
    const IncidentEdge go = seen_from(stay.end, gone, edges_[gone]);
    PartitionEdge& edge = edges_[stays];
    if (go.left == stay.left)
        edge = {from, stay.end, go.right, stay.right};
    else if (stay.right == go.right)
        edge = {from, stay.end, stay.left, go.left};
    else
        return false;
    if (edge.left == edge.right)
        remove(stays);
    return true;
}

/// Returns true if consecutive edges around a node agree on the sector between them.
bool PartitionEditor::agrees(std::uint32_t node) const {
    const std::vector<IncidentEdge> arms = around(node);
    for (std::size_t i = 0; i < arms.size(); ++i)
        if (arms[i].left != arms[i + 1 == arms.size() ? 0 : i + 1].right)
            return false;
    return true;
}

/// Returns the other ends of a node's edges, if all edges can follow the node.
std::optional<std::set<std::uint32_t>> PartitionEditor::movable_ends(std::uint32_t node,
                                                                     std::uint32_t into) const {
    std::set<std::uint32_t> ends;
    for (const std::uint32_t e : at_node_[node]) {
        const std::uint32_t end = other_end(e, node);
        if (end == into)
            continue;
        const bool lies_on_another = std::ranges::any_of(ends, [&](std::uint32_t known) {
            return outline::overlap_from(nodes_[into], nodes_[known], nodes_[end]);
        });
        if (lies_on_another || !is_sweep_clear(node, into, end))
            return std::nullopt;
        ends.insert(end);
    }
    return ends;
}

PartitionEditor::Undo PartitionEditor::remember(std::uint32_t node, std::uint32_t into,
                                                const std::set<std::uint32_t>& ends) const {
    Undo undo;
    for (const std::uint32_t n : {node, into}) {
        undo.nodes.emplace_back(n, at_node_[n]);
        for (const std::uint32_t e : at_node_[n])
            undo.edges.emplace_back(e, edges_[e]);
    }
    for (const std::uint32_t end : ends)
        undo.nodes.emplace_back(end, at_node_[end]);
    return undo;
}

/// @return true if coinciding edges agree on the area between them
bool PartitionEditor::move_edge(std::uint32_t edge, std::uint32_t node, std::uint32_t into) {
    const std::uint32_t end = other_end(edge, node);
    const auto there = end == into ? std::nullopt : edge_between(into, end);
    if (end == into || there) {
        const bool good = !there || combine(edge, *there, into);
        remove(edge);
        return good;
    }
    (edges_[edge].from == node ? edges_[edge].from : edges_[edge].to) = into;
    detach(edge, node);
    at_node_[into].push_back(edge);
    return true;
}

bool PartitionEditor::merge(std::uint32_t node, std::uint32_t into) {
    const auto ends = movable_ends(node, into);
    if (!ends)
        return false;
    Undo undo = remember(node, into, *ends);
    const std::vector<std::uint32_t> moved = at_node_[node];
    bool good = true;
    for (const std::uint32_t e : moved)
        good = move_edge(e, node, into) && good;
    const auto in_order = [&](std::uint32_t end) { return agrees(end); };
    if (!good || !agrees(into) || !std::ranges::all_of(*ends, in_order)) {
        for (const auto& [e, edge] : undo.edges)
            edges_[e] = edge;
        for (auto& [n, list] : undo.nodes)
            at_node_[n] = std::move(list);
        return false;
    }
    for (const std::uint32_t e : moved)
        if (is_edge(e))
            index(e);
    changes_.emplace_back(node, into);
    for (const std::uint32_t end : *ends) {
        changes_.emplace_back(node, end);
        changes_.emplace_back(into, end);
    }
    return true;
}

/// Returns true if an edge can be split at a place. On the edge, that is always possible; next to it, the two
/// halves sweep a triangle, which must be free.
bool PartitionEditor::may_split(std::uint32_t edge, FinePoint place) const {
    const PartitionEdge& whole = edges_[edge];
    const FinePoint a = nodes_[whole.from];
    const FinePoint b = nodes_[whole.to];
    if (place == a || place == b)
        return false;
    if (outline::side(a, b, place) == 0)
        return outline::boxes_intersect({a, b}, {place, place});
    return grid_.all_in_triangle(a, b, place, [&](std::uint32_t e) {
        if (!is_edge(e) || e == edge)
            return true;
        const PartitionEdge& other = edges_[e];
        return is_disjoint_from(e, whole.from, place) && is_disjoint_from(e, whole.to, place) &&
               std::ranges::none_of(std::array{other.from, other.to}, [&](std::uint32_t end) {
                   return end != whole.from && end != whole.to &&
                          outline::in_triangle(a, b, place, nodes_[end]);
               });
    });
}

std::optional<std::uint32_t> PartitionEditor::split(std::uint32_t edge, FinePoint place) {
    if (!may_split(edge, place))
        return std::nullopt;
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    const auto rest = static_cast<std::uint32_t>(edges_.size());
    nodes_.push_back(place);
    // The longer half keeps the number and the buckets, because repeated splits of a long edge would
    // otherwise cost its length each time.
    PartitionEdge& kept = edges_[edge];
    const std::uint32_t from = kept.from;
    const std::uint32_t to = kept.to;
    const bool keeps_start =
        outline::step_distance(place, nodes_[from]) >= outline::step_distance(place, nodes_[to]);
    const std::uint32_t far = keeps_start ? to : from;
    const double off = std::abs(static_cast<double>(outline::turn(nodes_[from], nodes_[to], place)));
    const bool is_beside = off > outline::step_distance(nodes_[from], nodes_[to]);
    edges_.push_back(keeps_start ? PartitionEdge{node, to, kept.left, kept.right}
                                 : PartitionEdge{from, node, kept.left, kept.right});
    (keeps_start ? edges_[edge].to : edges_[edge].from) = node;
    std::ranges::replace(at_node_[far], edge, rest);
    at_node_.push_back({edge, rest});
    if (is_beside)
        index(edge);
    index(rest);
    changes_.insert(changes_.end(), {{from, to}, {from, node}, {node, to}});
    return node;
}

void PartitionEditor::undo_splits(std::size_t nodes) {
    while (nodes_.size() > nodes) {
        const auto node = static_cast<std::uint32_t>(nodes_.size() - 1);
        const std::uint32_t edge = at_node_[node][0];
        const std::uint32_t rest = at_node_[node][1];
        const std::uint32_t far = other_end(rest, node);
        (edges_[edge].to == node ? edges_[edge].to : edges_[edge].from) = far;
        std::ranges::replace(at_node_[far], rest, edge);
        edges_.pop_back();
        at_node_.pop_back();
        nodes_.pop_back();
        changes_.resize(changes_.size() - 3);
    }
}

PlanarPartition PartitionEditor::plan() const {
    std::vector<PartitionEdge> left = edges_;
    std::erase_if(left, [](const PartitionEdge& edge) { return edge.from == edge.to; });
    return plan_of(std::move(left), nodes_);
}

}  // namespace d2b::surface
