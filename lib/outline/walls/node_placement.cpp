#include "outline/walls/node_placement.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace d2b::outline {
namespace {

constexpr double min_node_spacing = 1.0 / 16;  // cells between nodes

/// Distances in cells: the largest displacement of a node for the sake of a wall or a corner, and the
/// distance within which it snaps to a vertex.
constexpr double max_node_displacement = 1.0;
constexpr double max_corner_displacement = 1.25;
constexpr double snap_distance = 0.5;
constexpr double share_of_tolerance =
    0.9;  // limit of displacements, because arcs that end at the node must stay near their traces

}  // namespace

PlacedPolyline::PlacedPolyline(ChainPolyline drawn, const Chain& chain, const ChainFitMode& mode,
                               const TraceSums& samples, double tolerance)
    : samples_(&samples), drawn_(std::move(drawn)), max_displacement_(share_of_tolerance * tolerance) {
    vertices_.reserve(drawn_.vertices.size());
    for (const FinePoint vertex : drawn_.vertices)
        vertices_.push_back(samples_->from_fine(vertex));
    begins_.reserve(vertices_.size() + 1);
    begins_.push_back(0);
    for (std::size_t k = 0; k + (closed() ? 0 : 1) < vertices_.size(); ++k)
        begins_.push_back(begins_.back() + length(vertex(k + 1) - vertex(k)));
    nodes_.resize(chain.nodes.size() - (closed() ? 1 : 0));
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        nodes_[k].step = chain.node_steps[k];
        if (closed() && nodes_[k].step < drawn_.steps.front())
            nodes_[k].step += samples.steps();
    }
    if (!closed()) {
        nodes_.front().point = drawn_.vertices.front();
        nodes_.back().point = drawn_.vertices.back();
        nodes_.back().at = begins_.back();
        nodes_.back().edge = edges() - 1;
        placed_.insert(0);
        placed_.insert(nodes_.size() - 1);
    }
    for (std::size_t k = closed() ? 0 : 1; k + (closed() ? 0 : 1) < nodes_.size(); ++k)
        if (mode.beveled_around(nodes_[k].step))
            keep_traced(k);
}

/// Keeps a node at its traced position if the chain is beveled there, because it is a vertex then.
void PlacedPolyline::keep_traced(std::size_t k) {
    PlacedNode& node = nodes_[k];
    const auto vertex = std::ranges::lower_bound(drawn_.steps, node.step);
    const auto i = static_cast<std::size_t>(vertex - drawn_.steps.begin());
    const FinePoint place = samples_->to_fine(traced(node));
    if (vertex == drawn_.steps.end() || drawn_.vertices[i] != place)
        return;
    node.is_fixed = true;
    node.point = place;
    node.edge = std::min(i, edges() - 1);
    node.at = begins_[i];
    placed_.insert(k);
}

/// Edge that corresponds to a step of the trace.
std::size_t PlacedPolyline::edge_of(std::size_t step) const {
    const auto next = std::upper_bound(drawn_.steps.begin(), drawn_.steps.end(), step);
    const auto edge = static_cast<std::size_t>(next - drawn_.steps.begin());
    return std::min(edge > 0 ? edge - 1 : 0, edges() - 1);
}

double PlacedPolyline::preferred_position(const PlacedNode& node, const std::optional<Line2>& wall) const {
    const Vec2 at_trace = traced(node);
    const std::size_t edge = edge_of(node.step);
    const auto foot_on = [&](std::size_t e) {
        const double share = nearest_parameter(at_trace, vertex(e), vertex(e + 1));
        return begins_[e] + share * (begins_[e + 1] - begins_[e]);
    };
    if (!wall)
        return foot_on(edge);
    // A wall that continues a wall of the drawing beyond a corner begins at that corner.
    for (std::size_t v = edge > 0 ? edge - 1 : 0; v < std::min(edge + 3, edges()); ++v) {
        const auto parallel = [&](std::size_t e) {
            const Vec2 along = vertex(e + 1) - vertex(e);
            return std::abs(cross(along, wall->along)) < 0.3 * length(along);
        };
        const bool inner = v > 0 && (parallel(v - 1) != parallel(v));
        if (inner && length(vertex(v) - at_trace) < std::min(max_corner_displacement, max_displacement_))
            return begins_[v];
    }
    double best = foot_on(edge);
    double nearest = std::min(max_node_displacement, max_displacement_);
    for (std::size_t e = edge > 0 ? edge - 1 : 0; e < std::min(edge + 2, edges()); ++e) {
        const Vec2 from = vertex(e);
        const Vec2 along = vertex(e + 1) - from;
        const double sine = cross(along, wall->along);
        if (std::abs(sine) < 0.3 * length(along))
            continue;
        const double share = cross(wall->through - from, wall->along) / sine;
        const double away = length(from + share * along - at_trace);
        if (share >= 0 && share <= 1 && away < nearest) {
            nearest = away;
            best = begins_[e] + share * (begins_[e + 1] - begins_[e]);
        }
    }
    return best;
}

/// Range of positions along the drawing that keeps the order of the nodes.
void PlacedPolyline::find_range(std::size_t k, double& low, double& high) const {
    const std::size_t n = nodes_.size();
    const double whole = begins_.back();
    // Nodes are in the order of their steps; those of a closed chain start anywhere.
    if (placed_.empty())
        return;
    const auto next = placed_.upper_bound(k);
    if (next != placed_.begin() || closed()) {
        const std::size_t before = *std::prev(next != placed_.begin() ? next : placed_.end());
        const PlacedNode& other = nodes_[before];
        const std::size_t between = before < k ? k - before : k + n - before;
        low = other.at + (other.step > nodes_[k].step ? -whole : 0) +
              min_node_spacing * static_cast<double>(between);
    }
    if (next != placed_.end() || closed()) {
        const std::size_t after = next != placed_.end() ? *next : *placed_.begin();
        const PlacedNode& other = nodes_[after];
        const std::size_t between = after > k ? after - k : after + n - k;
        high = other.at + (other.step < nodes_[k].step ? whole : 0) -
               min_node_spacing * static_cast<double>(between);
    }
}

void PlacedPolyline::set_position(PlacedNode& node, double at) {
    const double whole = begins_.back();
    node.at = at;
    const double round = closed() ? at - std::floor(at / whole) * whole : at;
    const auto next = std::upper_bound(begins_.begin(), begins_.end(), round);
    node.edge = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - begins_.begin(), 1)) - 1,
                         edges() - 1);
    const double edge_length = begins_[node.edge + 1] - begins_[node.edge];
    const double share = edge_length > 0 ? (round - begins_[node.edge]) / edge_length : 0;
    const Vec2 from = vertex(node.edge);
    node.point = samples_->to_fine(from + share * (vertex(node.edge + 1) - from));
}

void PlacedPolyline::place(std::size_t k, const std::optional<Line2>& wall) {
    PlacedNode& node = nodes_[k];
    if (node.point)
        return;
    double low = -1e300;
    double high = 1e300;
    find_range(k, low, high);
    if (!closed()) {
        low = std::max(low, 0.0);
        high = std::min(high, begins_.back());
    }
    double at = preferred_position(node, wall);
    auto vertex_at = std::lower_bound(begins_.begin() + 1, begins_.end() - 1, at);
    if (std::abs(*(vertex_at - 1) - at) <= std::abs(*vertex_at - at))
        --vertex_at;
    const auto v = static_cast<std::size_t>(vertex_at - begins_.begin());
    if (std::abs(*vertex_at - at) < snap_distance && length(vertex(v) - traced(node)) < max_displacement_)
        at = *vertex_at;
    set_position(node, std::max(low, std::min(high, at)));
    placed_.insert(k);
}

void PlacedPolyline::cut(const PlacedNode& from, const PlacedNode& to, ChainPolyline& arc) const {
    const auto add = [&](FinePoint point, std::size_t step) {
        arc.vertices.push_back(point);
        arc.steps.push_back(step);
    };
    add(*from.point, from.step);
    // The way may lead around to the same node, or to a previous one on the same edge.
    double left = to.at - from.at;
    if (closed() && left <= 0)
        left += begins_.back();
    std::size_t edge = from.edge;
    const bool around = closed() && edge == to.edge && left > begins_[edge + 1] - begins_[edge];
    for (bool first = true; edge != to.edge || (first && around); first = false) {
        edge = edge + 1 < edges() ? edge + 1 : 0;
        const FinePoint next = drawn_.vertices[edge];
        if (next != arc.vertices.back() && next != *to.point)
            add(next, drawn_.steps[edge]);
    }
    add(*to.point, to.step);
}

/// Makes the steps of an arc ascend between those of its nodes.
void PlacedPolyline::match(ChainPolyline& arc, std::size_t first, std::size_t last) const {
    const std::size_t steps = samples_->steps();
    if (closed() && last <= first)
        last += steps;
    std::size_t before = first;
    for (std::size_t& step : arc.steps) {
        const auto away = [&](std::size_t s) { return s < first ? first - s : (s > last ? s - last : 0); };
        if (closed() && away(step + steps) < away(step))
            step += steps;
        else if (closed() && step >= steps && away(step - steps) < away(step))
            step -= steps;
        step = std::clamp(step, before, last);
        before = step;
    }
    arc.steps.front() = first;
    arc.steps.back() = last;
}

/// Circular arcs are in the order of the drawing, so an arc that wraps around has the last ones first.
void PlacedPolyline::add_arcs(const PlacedNode& from, ChainPolyline& arc) const {
    const std::size_t count = drawn_.vertices.size();
    const std::vector<FinePoint>& points = arc.vertices;
    const auto own = std::ranges::lower_bound(drawn_.arcs, from.edge, {}, &CircularArc::first);
    const auto begin = static_cast<std::size_t>(own - drawn_.arcs.begin());
    std::size_t before_the_end = 0;
    auto at = points.begin();
    for (std::size_t i = 0; i < drawn_.arcs.size(); ++i) {
        const bool round = begin + i >= drawn_.arcs.size();
        const CircularArc& span = drawn_.arcs[begin + i - (round ? drawn_.arcs.size() : 0)];
        const auto first = std::find(at, points.end(), drawn_.vertices[span.first]);
        if (first == points.end() && span.first == from.edge)
            continue;  // it begins before the node
        if (points.end() - first <= static_cast<std::ptrdiff_t>(span.edges))
            break;
        at = first;
        bool whole = true;
        for (std::size_t k = 1; k <= span.edges && whole; ++k)
            whole = first[static_cast<std::ptrdiff_t>(k)] == drawn_.vertices[(span.first + k) % count];
        if (whole)
            arc.arcs.push_back({0, static_cast<std::uint32_t>(first - points.begin()), span.edges});
        if (!round)
            before_the_end = arc.arcs.size();
    }
    std::rotate(arc.arcs.begin(), arc.arcs.begin() + static_cast<std::ptrdiff_t>(before_the_end),
                arc.arcs.end());
}

void PlacedPolyline::whole(ChainPolyline& drawn) const {
    drawn = drawn_;
    drawn.vertices.push_back(drawn_.vertices.front());
    drawn.steps.push_back(drawn_.steps.front() + samples_->steps());
}

void PlacedPolyline::extract(std::size_t from_node, std::size_t to_node, ChainPolyline& drawn) const {
    const PlacedNode& from = nodes_[from_node];
    const PlacedNode& to = nodes_[to_node < nodes_.size() ? to_node : 0];
    if (closed() && nodes_.size() == 1 && !from.point) {
        whole(drawn);  // it has no nodes
        return;
    }
    drawn.vertices.clear();
    drawn.steps.clear();
    drawn.arcs.clear();
    cut(from, to, drawn);
    match(drawn, from.step, to.step);
    drawn.deviation = deviation(*samples_, drawn, false);
    add_arcs(from, drawn);
}

FinePoint NodePositions::at(std::uint32_t node) const {
    const WallGraph::Node& n = graph_.nodes[node];
    return n.owner == WallGraph::none ? fine(n.at)
                                      : states_[n.owner].polyline.node(n.place).value_or(fine(n.at));
}

double NodePositions::displacement(std::uint32_t node) const {
    return length(shape_.from_fine(at(node), graph_.nodes[node].at));
}

FinePoint NodePositions::place_node(std::uint32_t node, const std::optional<Line2>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::none)
        states_[n.owner].polyline.place(n.place, wall);
    return at(node);
}

/// Supporting line of the last wall of a chain, relative to the first point of the chain on which it ends.
std::optional<Line2> NodePositions::wall_at_end(std::uint32_t c, bool last) const {
    const Chain& chain = graph_.chains[c];
    const ChainWalls& walls = states_[c].chain->walls();
    const std::uint32_t owner = graph_.nodes[chain.end_node(last)].owner;
    const std::size_t step = last ? chain.node_steps.back() - 1 : 0;
    if (owner == WallGraph::none || walls.empty() || states_[c].mode.at(step) != FitMode::regularized)
        return {};
    const WallSegment segment = walls.segment(last ? walls.size() - 1 : 0);
    if (segment.circle)
        return {};
    const LatticePoint origin = graph_.chains[owner].trace.front();
    return Line2{shape_.from_fine(fine(chain.trace.front()), origin) + segment.line.through,
                 segment.line.along};
}

std::optional<ChainEnds> NodePositions::place_ends(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    if (chain.closed)
        return {};
    return ChainEnds{place_node(chain.end_node(false), wall_at_end(c, false)),
                     place_node(chain.end_node(true), wall_at_end(c, true))};
}

}  // namespace d2b::outline
