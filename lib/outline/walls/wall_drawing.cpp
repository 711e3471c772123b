#include "outline/walls/wall_drawing.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "outline/walls/reference_direction.hpp"

namespace d2b {
namespace {

constexpr std::array tried_prices{1.0, 0.5};  // prices of walls, tried in turn

}  // namespace

WallDrawing::WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                         const StopRequest& stop)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      stop_(stop),
      states_(graph.chains.size()),
      places_(graph, states_, options.shape),
      reset_(graph.nodes.size()) {
    for (std::size_t c = 0; c < states_.size(); ++c)
        states_[c].form = ChainForm(graph.chains[c].steps(), graph.chains[c].closed);
}

/// Chains that are drawn for their own sake place their ends anew. Any chain that changes places the nodes on
/// it anew; the chains that end there have a higher rank and are drawn later.
std::vector<std::uint32_t> WallDrawing::draw() {
    std::vector<std::uint32_t> drawn;
    reset_.assign(reset_.size(), 0);
    for (std::uint32_t c = 0; c < states_.size(); ++c)
        if (states_[c].waiting && !graph_.chains[c].closed)
            for (const bool last : {false, true})
                reset(graph_.chains[c].end_node(last));
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        ChainState& state = states_[c];
        if (!state.waiting && (!std::exchange(state.lands, false) || places_.land_ends(c) == state.ends))
            continue;
        stop_.check();
        draw_chain(c);
        drawn.push_back(c);
        const Chain& chain = graph_.chains[c];
        for (std::size_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size(); ++k)
            reset(chain.nodes[k]);
    }
    first_ = false;
    return changed_arcs(drawn);
}

/// Removes a node from its chain; the chains that end there have to be placed again.
void WallDrawing::reset(std::uint32_t node) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (first_ || n.owner == WallGraph::nobody || std::exchange(reset_[node], std::uint8_t{1}) != 0)
        return;
    if (states_[n.owner].chain)
        states_[n.owner].course.take_away(n.place);
    for (const std::uint32_t end : graph_.ends_at(node))
        if (const std::uint32_t chain = graph_.chain_of[end / 2]; chain != n.owner)
            states_[chain].lands = true;
}

/// Arcs of redrawn chains and arcs at nodes that were placed anew.
std::vector<std::uint32_t> WallDrawing::changed_arcs(const std::vector<std::uint32_t>& drawn) const {
    std::vector<std::uint32_t> changed;
    if (drawn.empty())
        return changed;
    std::vector<std::uint8_t> marked(graph_.chain_of.size());
    for (const std::uint32_t c : drawn) {
        const Chain& chain = graph_.chains[c];
        for (const ArcUse& use : chain.arcs)
            marked[use.arc] = 1;
        for (const bool last : {false, true})
            if (const std::uint32_t node = chain.end_node(last); reset_[node] != 0)
                for (const std::uint32_t end : graph_.ends_at(node))
                    marked[end / 2] = 1;
    }
    for (std::uint32_t arc = 0; arc < marked.size(); ++arc)
        if (marked[arc] != 0)
            changed.push_back(arc);
    return changed;
}

void WallDrawing::draw_chain(std::uint32_t c) {
    ChainState& state = states_[c];
    const Chain& chain = graph_.chains[c];
    state.waiting = false;
    if (!state.chain)
        state.chain = std::make_unique<ChainDrawing>(chain, options_);
    if (state.form.has_walls() && state.chain->walls().empty())
        plan(c);
    state.ends = places_.land_ends(c);
    state.course = Course(state.chain->draw(state.form, state.ends), chain, state.form,
                          state.chain->samples(), options_.shape, options_.tolerance);
}

/// Divides a chain into walls, as few as possible within the tolerance.
void WallDrawing::plan(std::uint32_t c) {
    ChainState& state = states_[c];
    state.direction = direction(c);
    for (const double price : tried_prices) {
        const std::optional<double> direction = state.chain->plan(price, state.direction, stop_);
        if (!direction)
            continue;
        state.direction = *direction;
        if (state.chain->walls_are_near(places_.land_ends(c)))
            return;
    }
    if (state.chain->walls().empty())
        state.form.raise_all(Form::middles);
}

/// Direction used for planning the walls of a chain.
double WallDrawing::direction(std::uint32_t c) const {
    const double own = states_[c].chain->own_direction();
    const std::uint32_t base = reference_chain(graph_, cluster_, c);
    if (base == WallGraph::nobody)
        return own;
    return follow_direction(own, states_[base].direction, graph_.chains[c].steps());
}

void WallDrawing::arc(std::uint32_t arc, DrawnChain& drawn) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const std::size_t k = graph_.place_of[arc];
    states_[c].course.stretch(k, k + 1, states_[c].chain->samples(), drawn);
    if (!graph_.chains[c].arcs[k].reversed)
        return;
    const auto last = static_cast<std::uint32_t>(drawn.vertices.size() - 1);
    std::reverse(drawn.vertices.begin(), drawn.vertices.end());
    std::reverse(drawn.steps.begin(), drawn.steps.end());
    for (CircularArc& span : drawn.arcs)
        span.first = last - span.first - span.edges;
}

bool WallDrawing::stretch(const ArcUse& first, const ArcUse& last, bool whole, DrawnChain& drawn) const {
    const std::uint32_t c = graph_.chain_of[first.arc];
    const Chain& chain = graph_.chains[c];
    const std::size_t k = graph_.place_of[first.arc];
    const bool against = chain.arcs[k].reversed != first.reversed;
    const std::size_t from = against ? graph_.place_of[last.arc] : k;
    const std::size_t to = against ? k : graph_.place_of[last.arc];
    const Course& course = states_[c].course;
    if (whole)
        course.whole(states_[c].chain->samples(), drawn);
    else
        course.stretch(from, to + 1, states_[c].chain->samples(), drawn);
    return against;
}

bool WallDrawing::follow_closer(std::uint32_t c, std::size_t first, std::size_t last, std::size_t margin) {
    const bool closer = states_[c].form.follow_closer(first, last, margin);
    states_[c].waiting = states_[c].waiting || closer;
    return closer;
}

void WallDrawing::trace(std::uint32_t c) {
    if (states_[c].form.raise_all(Form::cut))
        states_[c].waiting = true;
}

bool WallDrawing::follow_closer_at(std::uint32_t node, std::size_t margin) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::nobody || places_.at(node) == fine(n.at))
        return false;
    const std::uint32_t step = graph_.chains[n.owner].node_steps[n.place];
    return follow_closer(n.owner, step, step + 1, margin);
}

std::vector<WallDrawing::Wall> WallDrawing::walls_along(std::uint32_t arc) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const ChainWalls& pieces = states_[c].chain->walls();
    const std::vector<std::uint32_t>& steps = graph_.chains[c].node_steps;
    const std::size_t k = graph_.place_of[arc];
    std::vector<Wall> walls;
    for (const std::size_t i : pieces.along(steps[k], steps[k + 1], stop_))
        if (const WallPiece piece = pieces.piece(i);
            form(c).at((piece.first + piece.last) / 2) == Form::walls)
            walls.push_back({c, i});
    return walls;
}

double WallDrawing::length(Wall wall) const {
    return states_[wall.chain].chain->walls().length(wall.piece);
}

void WallDrawing::shift(Wall wall, double cells) {
    ChainState& state = states_[wall.chain];
    state.chain->shift(wall.piece, cells);
    state.waiting = true;
}

}  // namespace d2b
