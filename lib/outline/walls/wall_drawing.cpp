#include "outline/walls/wall_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "outline/walls/draw_walls.hpp"
#include "outline/walls/turning_points.hpp"

namespace d2b {
namespace {

constexpr double snapping = 0.002;            // cells that a vertex may move onto the fine lattice
constexpr std::array tried_prices{1.0, 0.5};  // of walls, that are tried in turn

bool has_area(const DrawnChain& drawn, const WallSamples& samples, const CellShape& shape,
              LatticePoint origin) {
    return drawn.vertices.size() >= 3 && twice_area(drawn.vertices, shape, origin) * twice_area(samples) > 0;
}

/// Chains are known by their first edges.
using ChainKey = std::tuple<LatticePoint, LatticePoint, std::uint32_t>;

std::vector<ChainKey> keys_of(const WallGraph& graph) {
    std::vector<ChainKey> keys;
    keys.reserve(graph.chains.size());
    for (std::uint32_t c = 0; c < graph.chains.size(); ++c)
        keys.emplace_back(graph.chains[c].trace[0], graph.chains[c].trace[1], c);
    std::sort(keys.begin(), keys.end());
    return keys;
}

}  // namespace

WallDrawing::WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                         const StopRequest& stop)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      stop_(stop),
      states_(graph.chains.size()),
      plain_(graph.nodes.size()),
      reset_(graph.nodes.size()) {}

/// What is drawn for its own sake places its ends anew. Whatever changes places the nodes on it anew; what
/// ends there is of higher rank and has its turn later.
std::vector<std::uint32_t> WallDrawing::draw() {
    drawn_.clear();
    reset_.assign(reset_.size(), 0);
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        State& state = states_[c];
        state.waiting = state.waiting || (!first_ && state.form != state.drawn);
        if (state.waiting && !graph_.chains[c].closed)
            for (const bool last : {false, true})
                reset(end_node(graph_.chains[c], last));
    }
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
    if (states_[n.owner].drawn == Form::fitted)
        states_[n.owner].course.take_away(n.place);
    for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
        if (const std::uint32_t chain = graph_.chain_of[graph_.arc_ends[e] / 2]; chain != n.owner)
            states_[chain].lands = true;
}

bool WallDrawing::ends_where_it_did(std::uint32_t c) {
    const State& state = states_[c];
    if (state.form != state.drawn)
        return false;
    if (state.drawn == Form::traced)
        return true;
    const Chain& chain = graph_.chains[c];
    const std::optional<ChainEnds> before = state.ends;
    const std::optional<ChainEnds> now =
        state.drawn == Form::fitted
            ? land_ends(chain, state.walls->piece(0), state.walls->piece(state.walls->size() - 1))
            : ChainEnds{land(end_node(chain, false), {}), land(end_node(chain, true), {})};
    return now == before;
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
    if (n.owner == WallGraph::nobody || states_[n.owner].drawn != Form::fitted)
        return fine(n.at);
    return states_[n.owner].course.node(n.place).value_or(fine(n.at));
}

FinePoint WallDrawing::land(std::uint32_t node, const std::optional<Line>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::nobody && states_[n.owner].drawn == Form::fitted)
        states_[n.owner].course.place(n.place, plain_[node] ? std::nullopt : wall);
    return place(node);
}

void WallDrawing::draw_chain(std::uint32_t c) {
    State& state = states_[c];
    state.waiting = false;
    state.drawn = Form::fitted;
    if (state.form == Form::fitted && fit(c))
        return;
    state.course = {};
    state.walls.reset();
    if (state.form == Form::fitted)
        simplify(c);
    state.drawn = state.form;
    if (state.form == Form::joined)
        land_traced(c);
}

/// Places the ends of a chain that is drawn as it was traced but for these.
void WallDrawing::land_traced(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    const LatticePoint origin = chain.trace.front();
    states_[c].ends = ChainEnds{land(end_node(chain, false), {}), land(end_node(chain, true), {})};
    for (const bool last : {false, true}) {
        const FinePoint landed = last ? states_[c].ends->last : states_[c].ends->first;
        const Vec moved = options_.shape.from_fine(landed, origin) -
                          options_.shape.from_fine(fine(graph_.nodes[end_node(chain, last)].at), origin);
        if (d2b::length(moved) > options_.tolerance)
            simplify(c);
    }
}

/// Lets an arc as it was traced end on what the chain ends on.
void WallDrawing::join(const Chain& chain, std::size_t k, DrawnChain& drawn) const {
    const auto land = [&](bool last) {
        FinePoint& end = last != chain.arcs[k].reversed ? drawn.vertices.back() : drawn.vertices.front();
        const FinePoint landed = place(end_node(chain, last));
        const LatticePoint origin = chain.trace.front();
        drawn.deviation = std::max(drawn.deviation, d2b::length(options_.shape.from_fine(landed, origin) -
                                                                options_.shape.from_fine(end, origin)));
        end = landed;
    };
    if (k == 0)
        land(false);
    if (k + 1 == chain.arcs.size())
        land(true);
}

void WallDrawing::arc(std::uint32_t arc, DrawnChain& drawn) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const State& state = states_[c];
    const Chain& chain = graph_.chains[c];
    const std::size_t k = graph_.place_of[arc];
    if (state.drawn != Form::fitted) {
        drawn.vertices.clear();
        for (const LatticePoint point : graph_.graph.arcs[arc])
            drawn.vertices.push_back(fine(point));
        drawn.arcs.clear();
        drawn.deviation = 0;
        if (state.drawn == Form::joined)
            join(chain, k, drawn);
        return;
    }
    state.course.arc(k, state.walls->samples(), drawn);
    if (!chain.arcs[k].reversed)
        return;
    const auto last = static_cast<std::uint32_t>(drawn.vertices.size() - 1);
    std::reverse(drawn.vertices.begin(), drawn.vertices.end());
    for (CircularArc& span : drawn.arcs)
        span.first = last - span.first - span.edges;
}

bool WallDrawing::simplify(std::uint32_t c) {
    State& state = states_[c];
    if (state.form == Form::traced)
        return false;
    if (!graph_.chains[c].closed && state.form == Form::fitted) {
        state.form = Form::joined;
        for (const bool last : {false, true})
            plain_[end_node(graph_.chains[c], last)] = true;
        return true;
    }
    // What a traced chain ends on is traced, too, and so on downwards.
    std::vector<std::uint32_t> open{c};
    while (!open.empty()) {
        const std::uint32_t traced = open.back();
        open.pop_back();
        if (std::exchange(states_[traced].form, Form::traced) == Form::traced)
            continue;
        const Chain& chain = graph_.chains[traced];
        if (chain.closed)
            continue;
        for (const bool last : {false, true}) {
            const std::uint32_t node = end_node(chain, last);
            plain_[node] = true;
            if (graph_.nodes[node].owner != WallGraph::nobody)
                open.push_back(graph_.nodes[node].owner);
        }
    }
    return true;
}

std::optional<ChainEnds> WallDrawing::land_ends(const Chain& chain, const WallPiece& first,
                                                const WallPiece& last) {
    if (chain.closed)
        return {};
    // Lines are seen from this chain's first point, those of the owner from its own.
    const auto line = [&](const WallPiece& piece, std::uint32_t node) -> std::optional<Line> {
        const std::uint32_t owner = graph_.nodes[node].owner;
        if (piece.circle || owner == WallGraph::nobody)
            return {};
        const LatticePoint origin = graph_.chains[owner].trace.front();
        return Line{options_.shape.from_fine(fine(chain.trace.front()), origin) + piece.line.through,
                    piece.line.along};
    };
    return ChainEnds{land(chain.nodes.front(), line(first, chain.nodes.front())),
                     land(chain.nodes.back(), line(last, chain.nodes.back()))};
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
    return states_[c].walls->samples().steps() < 16 || std::abs(turn) < near ? reference : own;
}

/// Divides a chain into walls. @param points where it may turn @return whether that is possible
bool WallDrawing::plan(std::uint32_t c, const std::vector<std::size_t>& points, double price) {
    State& state = states_[c];
    state.direction = reference_direction(c, dominant_direction(state.walls->samples(), points));
    return state.walls->plan(points, {options_.walls, options_.tolerance, price}, state.direction, stop_);
}

/// Draws the walls that are planned. @return whether they lie within the tolerance
bool WallDrawing::join_walls(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    State& state = states_[c];
    const WallSamples& samples = state.walls->samples();
    const LatticePoint origin = chain.trace.front();
    const std::vector<WallPiece> pieces = state.walls->pieces();
    state.ends = land_ends(chain, pieces.front(), pieces.back());
    DrawnChain drawn = draw_walls(samples, {options_.walls, options_.tolerance, 1}, options_.shape, origin,
                                  pieces, state.ends);
    const double limit = options_.tolerance - snapping;
    if (drawn.deviation > limit && state.tried + 1 >= tried_prices.size())
        keep_near(samples, {options_.walls, limit, 1}, options_.shape, origin, drawn);
    if (drawn.vertices.size() < 2 || drawn.deviation > limit ||
        (chain.closed && !has_area(drawn, samples, options_.shape, origin)))
        return false;
    state.course = Course(std::move(drawn), chain, samples, options_.shape);
    return true;
}

/// @return whether there are walls within the tolerance: few, or as many as are needed
bool WallDrawing::fit(std::uint32_t c) {
    State& state = states_[c];
    const Chain& chain = graph_.chains[c];
    if (!state.walls)
        state.walls.emplace(chain, options_.shape);
    if (!state.walls->empty()) {
        if (join_walls(c))
            return true;
        ++state.tried;  // what has been moved in vain
    }
    if (state.tried >= tried_prices.size())
        return false;
    std::vector<std::size_t> points = turning_points(state.walls->samples());
    for (; state.tried < tried_prices.size(); ++state.tried)
        if (plan(c, points, tried_prices[state.tried]) && join_walls(c))
            return true;
    return false;
}

std::vector<WallDrawing::Wall> WallDrawing::walls_along(std::uint32_t arc) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const State& state = states_[c];
    std::vector<Wall> walls;
    if (state.form != Form::fitted || state.drawn != Form::fitted)
        return walls;
    const std::vector<std::uint32_t>& steps = graph_.chains[c].node_steps;
    const std::size_t k = graph_.place_of[arc];
    for (const std::size_t piece : state.walls->along(steps[k], steps[k + 1], stop_))
        walls.push_back({c, piece});
    return walls;
}

double WallDrawing::length(Wall wall) const {
    return states_[wall.chain].walls->length(wall.piece);
}

void WallDrawing::shift(Wall wall, double cells) {
    State& state = states_[wall.chain];
    state.walls->shift(wall.piece, cells);
    state.waiting = true;
}

/// What ends on a chain that is drawn anew is drawn anew.
bool WallDrawing::can_adopt(const Chain& chain, const std::vector<bool>& adopted) const {
    return chain.closed || std::ranges::all_of(std::array{false, true}, [&](bool last) {
               const std::uint32_t owner = graph_.nodes[end_node(chain, last)].owner;
               return owner == WallGraph::nobody || adopted[owner];
           });
}

void WallDrawing::adopt(WallDrawing&& low) {
    const std::vector<ChainKey> keys = keys_of(low.graph_);
    std::vector<bool> adopted(states_.size());
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        const Chain& chain = graph_.chains[c];
        const auto key =
            std::lower_bound(keys.begin(), keys.end(), ChainKey{chain.trace[0], chain.trace[1], 0});
        if (key == keys.end() || std::get<0>(*key) != chain.trace[0] || std::get<1>(*key) != chain.trace[1])
            continue;
        const Chain& same = low.graph_.chains[std::get<2>(*key)];
        if (chain.rank != same.rank || chain.trace != same.trace || chain.closed != same.closed ||
            !can_adopt(chain, adopted))
            continue;
        adopt_chain(c, low, std::get<2>(*key));
        adopted[c] = true;
    }
}

void WallDrawing::adopt_chain(std::uint32_t c, WallDrawing& low, std::uint32_t low_chain) {
    State& state = states_[c];
    state = std::move(low.states_[low_chain]);
    const Chain& chain = graph_.chains[c];
    const Chain& same = low.graph_.chains[low_chain];
    const Course low_course = std::move(state.course);
    state.course = {};
    if (state.drawn == Form::fitted)
        state.course = Course(low_course.drawn(), chain, state.walls->samples(), options_.shape);
    // Its nodes are nodes here as well, at the same steps.
    std::size_t k = 0;
    for (std::size_t of_low = 0; of_low < same.nodes.size(); ++of_low) {
        const bool last = of_low + 1 == same.nodes.size();
        if (chain.closed && last)
            break;
        while (k + 1 < chain.nodes.size() && chain.node_steps[k] != same.node_steps[of_low])
            ++k;
        plain_[chain.nodes[k]] = low.plain_[same.nodes[of_low]];
        if (state.drawn == Form::fitted && low_course.node(of_low) &&
            chain.node_steps[k] == same.node_steps[of_low])
            state.course.place_as(k, low_course, of_low);
    }
}

}  // namespace d2b
