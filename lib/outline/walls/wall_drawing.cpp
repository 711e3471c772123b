#include "outline/walls/wall_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr std::array tried_prices{1.0, 0.5};  // of walls, that are tried in turn

}  // namespace

WallDrawing::WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                         const StopRequest& stop)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      stop_(stop),
      states_(graph.chains.size()),
      reset_(graph.nodes.size()) {
    for (std::size_t c = 0; c < states_.size(); ++c)
        states_[c].form = ChainForm(graph.chains[c].steps(), graph.chains[c].closed);
}

/// What is drawn for its own sake places its ends anew. Whatever changes places the nodes on it anew; what
/// ends there is of higher rank and has its turn later.
std::vector<std::uint32_t> WallDrawing::draw() {
    drawn_.clear();
    reset_.assign(reset_.size(), 0);
    for (std::uint32_t c = 0; c < states_.size(); ++c)
        if (states_[c].waiting && !graph_.chains[c].closed)
            for (const bool last : {false, true})
                reset(end_node(graph_.chains[c], last));
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        if (!states_[c].waiting && (!std::exchange(states_[c].lands, false) || ends_where_it_did(c)))
            continue;
        stop_.check();
        draw_chain(c);
        drawn_.push_back(c);
        const Chain& chain = graph_.chains[c];
        for (std::size_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size(); ++k)
            reset(chain.nodes[k]);
    }
    std::vector<std::uint32_t> changed = changed_arcs();
    first_ = false;
    return changed;
}

/// Takes a node away; all that ends there looks where to end.
void WallDrawing::reset(std::uint32_t node) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (first_ || n.owner == WallGraph::nobody || std::exchange(reset_[node], std::uint8_t{1}) != 0)
        return;
    if (states_[n.owner].chain)
        states_[n.owner].course.take_away(n.place);
    for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
        if (const std::uint32_t chain = graph_.chain_of[graph_.arc_ends[e] / 2]; chain != n.owner)
            states_[chain].lands = true;
}

bool WallDrawing::ends_where_it_did(std::uint32_t c) {
    const std::optional<ChainEnds> before = states_[c].ends;
    return land_ends(c) == before;
}

/// Those of all chains that have been drawn, and those beside nodes that have been placed anew.
std::vector<std::uint32_t> WallDrawing::changed_arcs() const {
    std::vector<std::uint8_t> marked(graph_.chain_of.size(), first_ ? 1 : 0);
    if (!first_)
        for (const std::uint32_t c : drawn_) {
            const Chain& chain = graph_.chains[c];
            for (const ArcUse& use : chain.arcs)
                marked[use.arc] = 1;
            for (const bool last : {false, true}) {
                const std::uint32_t node = end_node(chain, last);
                for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
                    if (reset_[node] != 0)
                        marked[graph_.arc_ends[e] / 2] = 1;
            }
        }
    std::vector<std::uint32_t> changed;
    if (drawn_.empty() && !first_)
        return changed;
    for (std::uint32_t arc = 0; arc < marked.size(); ++arc)
        if (marked[arc] != 0)
            changed.push_back(arc);
    return changed;
}

FinePoint WallDrawing::place(std::uint32_t node) const {
    const WallGraph::Node& n = graph_.nodes[node];
    return n.owner == WallGraph::nobody ? fine(n.at)
                                        : states_[n.owner].course.node(n.place).value_or(fine(n.at));
}

FinePoint WallDrawing::land(std::uint32_t node, const std::optional<Line>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::nobody)
        states_[n.owner].course.place(n.place, wall);
    return place(node);
}

double WallDrawing::displaced(std::uint32_t node) const {
    const LatticePoint traced = graph_.nodes[node].at;
    return d2b::length(options_.shape.from_fine(place(node), traced));
}

void WallDrawing::draw_chain(std::uint32_t c) {
    State& state = states_[c];
    const Chain& chain = graph_.chains[c];
    state.waiting = false;
    if (!state.chain)
        state.chain = std::make_unique<ChainDrawing>(chain, options_);
    if (state.form.has_walls() && state.chain->walls().empty())
        plan(c);
    state.ends = land_ends(c);
    state.course = Course(state.chain->draw(state.form, state.ends), chain, state.form,
                          state.chain->samples(), options_.shape, options_.tolerance);
}

/// Divides a chain into walls: few, or as many as are needed.
void WallDrawing::plan(std::uint32_t c) {
    State& state = states_[c];
    state.direction = reference_direction(c, state.chain->own_direction());
    for (const double price : tried_prices) {
        const std::optional<double> direction = state.chain->plan(price, state.direction, stop_);
        if (!direction)
            continue;
        state.direction = *direction;
        state.ends = land_ends(c);
        if (state.chain->walls_are_near(state.ends))
            return;
    }
    if (state.chain->walls().empty())
        state.form.raise_all(Form::middles);
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

bool WallDrawing::follow_closer(std::uint32_t c, Form most) {
    State& state = states_[c];
    const std::size_t steps = graph_.chains[c].steps();
    return state.form.least(0, steps) < most && follow_closer(c, 0, steps, 0);
}

bool WallDrawing::follow_closer_at(std::uint32_t node, std::size_t margin) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::nobody || place(node) == fine(n.at))
        return false;
    const std::uint32_t step = graph_.chains[n.owner].node_steps[n.place];
    return follow_closer(n.owner, step, step + 1, margin);
}

/// The line of the wall with which a chain ends, seen from the first point of the chain that it ends on.
std::optional<Line> WallDrawing::wall_at_end(std::uint32_t c, bool last) const {
    const Chain& chain = graph_.chains[c];
    const ChainWalls& walls = states_[c].chain->walls();
    const std::uint32_t owner = graph_.nodes[end_node(chain, last)].owner;
    const std::size_t step = last ? chain.node_steps.back() - 1 : 0;
    if (owner == WallGraph::nobody || walls.empty() || states_[c].form.at(step) != Form::walls)
        return {};
    const WallPiece piece = walls.piece(last ? walls.size() - 1 : 0);
    if (piece.circle)
        return {};
    const LatticePoint origin = graph_.chains[owner].trace.front();
    return Line{options_.shape.from_fine(fine(chain.trace.front()), origin) + piece.line.through,
                piece.line.along};
}

std::optional<ChainEnds> WallDrawing::land_ends(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    if (chain.closed)
        return {};
    return ChainEnds{land(end_node(chain, false), wall_at_end(c, false)),
                     land(end_node(chain, true), wall_at_end(c, true))};
}

double WallDrawing::reference_direction(std::uint32_t c, double own) const {
    constexpr double near = 12.0 / 180 * std::numbers::pi;
    const Chain& chain = graph_.chains[c];
    if (chain.rank < 3)
        return own;
    std::uint32_t base = chain.closed ? WallGraph::nobody : graph_.nodes[chain.nodes.front()].owner;
    if (base == WallGraph::nobody) {
        const WallGraph::Sides& sides = graph_.sides[chain.arcs.front().arc];
        auto contour = static_cast<std::int64_t>(std::max(sides.left, sides.right));
        while (contour >= 0 && cluster_.contours[static_cast<std::size_t>(contour)]->key.level > 1)
            contour = cluster_.parents[static_cast<std::size_t>(contour)];
        if (contour >= 0) {
            const ArcGraph::Outline& outline = graph_.graph.outlines[static_cast<std::size_t>(contour)];
            base = graph_.chain_of[outline.exterior.front().arc];
        }
    }
    if (base == WallGraph::nobody || graph_.chains[base].rank >= chain.rank)
        return own;
    const double reference = states_[base].direction;
    constexpr double right = std::numbers::pi / 2;
    const double turn = own - reference - std::round((own - reference) / right) * right;
    return states_[c].chain->samples().steps() < 16 || std::abs(turn) < near ? reference : own;
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
    State& state = states_[wall.chain];
    state.chain->walls().shift(wall.piece, cells);
    state.waiting = true;
}

}  // namespace d2b
