#include "outline/wall_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr double snapping = 0.002;            // cells that a vertex may move onto the fine lattice
constexpr std::array tried_prices{1.0, 0.5};  // of walls, that are tried in turn

/// Moves a wall to the left of the way that the chain runs.
void shift_wall(WallPiece& piece, const WallSamples& samples, double cells) {
    const Vec run = samples.at(piece.last) - samples.at(piece.first);
    if (piece.circle) {
        const Vec middle = samples.at((piece.first + piece.last) / 2) - piece.circle->centre;
        const bool whole = piece.last - piece.first == samples.steps();
        const bool turns_left = whole ? twice_area(samples) > 0 : cross(middle, run) > 0;
        piece.circle->radius += turns_left ? -cells : cells;
        return;
    }
    const double sign = dot(run, piece.line.along) > 0 ? 1 : -1;
    piece.line.through = piece.line.through + sign * cells * Vec{-piece.line.along.y, piece.line.along.x};
}

bool has_area(const DrawnChain& drawn, const WallSamples& samples, const CellShape& shape,
              LatticePoint origin) {
    return drawn.vertices.size() >= 3 && twice_area(drawn.vertices, shape, origin) * twice_area(samples) > 0;
}

}  // namespace

WallDrawing::WallDrawing(const WallGraph& graph, const std::vector<Contour>& contours,
                         const WallOptions& options)
    : graph_(graph),
      contours_(contours),
      options_(options),
      states_(graph.chains.size()),
      plain_(graph.nodes.size()) {}

void WallDrawing::draw(const std::vector<bool>& parts) {
    for (std::uint32_t c = 0; c < states_.size(); ++c)
        if (parts[graph_.part_of[c]])
            draw_chain(c);
}

FinePoint WallDrawing::place(std::uint32_t node) const {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::nobody)
        return fine(n.at);
    return states_[n.owner].course.node(n.place).value_or(fine(n.at));
}

FinePoint WallDrawing::land(std::uint32_t node, const std::optional<Line>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::nobody) {
        State& owner = states_[n.owner];
        owner.course.place(n.place, plain_[node] ? std::nullopt : wall, owner.drawn == Form::fitted);
    }
    return place(node);
}

std::optional<ChainEnds> WallDrawing::land_ends(const Chain& chain, const std::vector<WallPiece>& pieces) {
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
    return ChainEnds{land(chain.nodes.front(), line(pieces.front(), chain.nodes.front())),
                     land(chain.nodes.back(), line(pieces.back(), chain.nodes.back()))};
}

double WallDrawing::reference_direction(std::uint32_t c, const WallSamples& samples) const {
    constexpr double near = 12.0 / 180 * std::numbers::pi;
    const Chain& chain = graph_.chains[c];
    const double own = dominant_direction(samples);
    if (chain.rank < 3)
        return own;
    std::uint32_t base = chain.closed ? WallGraph::nobody : graph_.nodes[chain.nodes.front()].owner;
    if (base == WallGraph::nobody) {
        const WallGraph::Sides& sides = graph_.sides[chain.arcs.front().arc];
        std::int64_t contour = std::max(sides.left, sides.right);
        while (contour >= 0 && contours_[static_cast<std::size_t>(contour)].key.level > 1)
            contour = contours_[static_cast<std::size_t>(contour)].parent;
        if (contour >= 0)
            base =
                graph_
                    .chain_of[graph_.graph.outlines[static_cast<std::size_t>(contour)].exterior.front().arc];
    }
    if (base == WallGraph::nobody || graph_.chains[base].rank >= chain.rank)
        return own;
    const double reference = states_[base].direction;
    constexpr double right = std::numbers::pi / 2;
    const double turn = own - reference - std::round((own - reference) / right) * right;
    return samples.steps() < 16 || std::abs(turn) < near ? reference : own;
}

/// Divides a chain into walls. @return whether that is possible
bool WallDrawing::plan(std::uint32_t c, const WallSamples& samples, double price) {
    State& state = states_[c];
    const WallStyle style{options_.walls, options_.tolerance, price};
    state.direction = reference_direction(c, samples);
    std::optional<std::vector<WallPiece>> pieces = plan_walls(samples, style, state.direction);
    if (!pieces)
        return false;
    find_arcs(samples, style, *pieces);
    settle_ends(samples, *pieces);
    state.pieces = std::move(*pieces);
    state.shift.assign(state.pieces.size(), 0);
    state.shifts.assign(state.pieces.size(), 0);
    return true;
}

/// Draws the walls that are planned. @return whether they lie within the tolerance
bool WallDrawing::join_walls(std::uint32_t c, const WallSamples& samples) {
    const Chain& chain = graph_.chains[c];
    State& state = states_[c];
    std::vector<WallPiece> pieces = state.pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (state.shift[i] != 0)
            shift_wall(pieces[i], samples, state.shift[i]);
    DrawnChain drawn = draw_walls(samples, {options_.walls, options_.tolerance, 1}, options_.shape,
                                  chain.trace.front(), pieces, land_ends(chain, pieces));
    if (drawn.deviation > options_.tolerance - snapping && state.tried + 1 >= tried_prices.size())
        keep_near(samples, {options_.walls, options_.tolerance - snapping, 1}, options_.shape,
                  chain.trace.front(), drawn);
    if (drawn.vertices.size() < 2 || drawn.deviation > options_.tolerance - snapping ||
        (chain.closed && !has_area(drawn, samples, options_.shape, chain.trace.front())))
        return false;
    state.course = Course(std::move(drawn), chain, samples, options_.shape);
    return true;
}

/// @return whether there are walls within the tolerance: few, or as many as are needed
bool WallDrawing::fit(std::uint32_t c, const WallSamples& samples) {
    State& state = states_[c];
    if (!state.pieces.empty() && join_walls(c, samples))
        return true;
    for (; state.tried < tried_prices.size(); ++state.tried)
        if (plan(c, samples, tried_prices[state.tried]) && join_walls(c, samples))
            return true;
    return false;
}

DrawnChain WallDrawing::as_traced(const Chain& chain, const WallSamples& samples) {
    DrawnChain drawn;
    for (std::size_t i = 0; i < chain.trace.size(); ++i) {
        drawn.vertices.push_back(fine(chain.trace[i]));
        drawn.steps.push_back(samples.step_of(i));
    }
    if (chain.closed)
        return drawn;
    for (const bool last : {false, true}) {
        const std::uint32_t node = last ? chain.nodes.back() : chain.nodes.front();
        FinePoint& end = last ? drawn.vertices.back() : drawn.vertices.front();
        const FinePoint landed = land(node, {});
        drawn.deviation =
            std::max(drawn.deviation, d2b::length(options_.shape.from_fine(landed, chain.trace.front()) -
                                                  options_.shape.from_fine(end, chain.trace.front())));
        end = landed;
    }
    return drawn;
}

void WallDrawing::draw_chain(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    State& state = states_[c];
    const WallSamples samples(chain.trace, chain.closed, options_.shape);
    state.drawn = Form::fitted;
    state.node_steps.clear();
    for (std::size_t k = 0; k < chain.arcs.size(); ++k)
        state.node_steps.push_back(samples.step_of(chain.begins[k]));
    state.node_steps.push_back(samples.steps());
    if (state.form == Form::fitted && fit(c, samples))
        return;
    if (state.form == Form::fitted)
        simplify(c);
    state.drawn = state.form;
    DrawnChain drawn = as_traced(chain, samples);
    if (drawn.deviation > options_.tolerance)
        simplify(c);
    state.course = Course(std::move(drawn), chain, samples, options_.shape);
}

bool WallDrawing::simplify(std::uint32_t c) {
    State& state = states_[c];
    if (state.form == Form::traced)
        return false;
    if (!graph_.chains[c].closed && state.form == Form::fitted) {
        state.form = Form::joined;
        for (const std::uint32_t node : {graph_.chains[c].nodes.front(), graph_.chains[c].nodes.back()})
            plain_[node] = true;
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
        for (const std::uint32_t node : {chain.nodes.front(), chain.nodes.back()}) {
            plain_[node] = true;
            if (graph_.nodes[node].owner != WallGraph::nobody)
                open.push_back(graph_.nodes[node].owner);
        }
    }
    return true;
}

std::vector<WallDrawing::Wall> WallDrawing::walls_along(std::uint32_t c, std::size_t arc) const {
    constexpr int most_shifts = 10;
    constexpr double most = 0.7;
    const State& state = states_[c];
    std::vector<Wall> walls;
    if (state.form != Form::fitted)
        return walls;
    const std::size_t begin = state.node_steps[arc];
    const std::size_t end = state.node_steps[arc + 1];
    const std::size_t round = graph_.chains[c].closed ? state.node_steps.back() : 0;
    for (std::size_t i = 0; i < state.pieces.size(); ++i) {
        const WallPiece& piece = state.pieces[i];
        const auto common = [&](std::size_t from, std::size_t to) {
            const std::size_t first = std::max(from, piece.first);
            const std::size_t last = std::min(to, piece.last);
            return last > first ? last - first : 0;
        };
        const std::size_t along = common(begin, end) + (round > 0 ? common(begin + round, end + round) : 0);
        if (state.shifts[i] < most_shifts &&
            static_cast<double>(along) >= most * static_cast<double>(piece.last - piece.first))
            walls.push_back({c, i});
    }
    return walls;
}

double WallDrawing::length(Wall wall) const {
    const WallPiece& piece = states_[wall.chain].pieces[wall.piece];
    return static_cast<double>(piece.last - piece.first);
}

void WallDrawing::shift(Wall wall, double cells) {
    State& state = states_[wall.chain];
    ++state.shifts[wall.piece];
    state.shift[wall.piece] += cells;
}

}  // namespace d2b
