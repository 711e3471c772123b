#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "outline/wall_drawing.hpp"

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

/// A wall that is planned, where it has been moved to.
WallPiece WallDrawing::moved_piece(std::uint32_t c, std::size_t i) const {
    const State& state = states_[c];
    WallPiece piece = state.pieces[i];
    if (state.shifts[i].cells != 0)
        shift_wall(piece, *state.samples, state.shifts[i].cells);
    return piece;
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
    return states_[c].samples->steps() < 16 || std::abs(turn) < near ? reference : own;
}

/// Divides a chain into walls. @param points where it may turn @return whether that is possible
bool WallDrawing::plan(std::uint32_t c, const std::vector<std::size_t>& points, double price) {
    State& state = states_[c];
    const WallStyle style{options_.walls, options_.tolerance, price};
    state.direction = reference_direction(c, dominant_direction(*state.samples, points));
    std::optional<std::vector<WallPiece>> pieces =
        plan_walls(*state.samples, points, style, state.direction, stop_);
    if (!pieces)
        return false;
    find_arcs(*state.samples, style, *pieces, stop_);
    settle_ends(*state.samples, *pieces);
    state.pieces = std::move(*pieces);
    state.shifts.assign(state.pieces.size(), {});
    return true;
}

/// Draws the walls that are planned. @return whether they lie within the tolerance
bool WallDrawing::join_walls(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    State& state = states_[c];
    const WallSamples& samples = *state.samples;
    const LatticePoint origin = chain.trace.front();
    std::vector<WallPiece> pieces;
    pieces.reserve(state.pieces.size());
    for (std::size_t i = 0; i < state.pieces.size(); ++i)
        pieces.push_back(moved_piece(c, i));
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
    if (!state.samples)
        state.samples.emplace(chain.trace, chain.closed, options_.shape);
    if (!state.pieces.empty()) {
        if (join_walls(c))
            return true;
        ++state.tried;  // what has been moved in vain
    }
    if (state.tried >= tried_prices.size())
        return false;
    std::vector<std::size_t> points = turning_points(*state.samples);
    for (; state.tried < tried_prices.size(); ++state.tried)
        if (plan(c, points, tried_prices[state.tried]) && join_walls(c))
            return true;
    return false;
}

std::vector<WallDrawing::Wall> WallDrawing::walls_along(std::uint32_t arc) const {
    constexpr int most_shifts = 10;
    constexpr double most = 0.7;
    const std::uint32_t c = graph_.chain_of[arc];
    const State& state = states_[c];
    std::vector<Wall> walls;
    if (state.form != Form::fitted || state.drawn != Form::fitted)
        return walls;
    const Chain& chain = graph_.chains[c];
    const std::size_t begin = chain.node_steps[graph_.place_of[arc]];
    const std::size_t end = chain.node_steps[graph_.place_of[arc] + 1];
    const std::size_t round = state.samples->steps();
    const auto add = [&](std::size_t i) {
        stop_.check();
        const WallPiece& piece = state.pieces[i];
        const auto common = [&](std::size_t arc_round, std::size_t piece_round) {
            const std::size_t first = std::max(begin + arc_round, piece.first + piece_round);
            const std::size_t last = std::min(end + arc_round, piece.last + piece_round);
            return last > first ? last - first : 0;
        };
        const std::size_t along = common(0, 0) + (chain.closed ? common(round, 0) + common(0, round) : 0);
        if (state.shifts[i].times < most_shifts &&
            static_cast<double>(along) >= most * static_cast<double>(piece.last - piece.first))
            walls.push_back({c, i});
    };
    // In a closed chain either may reach round its end. Walls follow one another.
    std::size_t next = 0;
    for (std::size_t lap = chain.closed ? 0 : 1; lap < (chain.closed ? 3 : 2); ++lap) {
        const auto ends_after = [&](const WallPiece& piece) {
            return piece.last + round > begin + lap * round;
        };
        const auto begins_before = [&](const WallPiece& piece) {
            return piece.first + round < end + lap * round;
        };
        const auto& pieces = state.pieces;
        const auto low = std::ranges::partition_point(pieces, std::not_fn(ends_after));
        const auto high = std::ranges::partition_point(pieces, begins_before);
        next = std::max(next, static_cast<std::size_t>(low - pieces.begin()));
        for (; next < static_cast<std::size_t>(high - pieces.begin()); ++next)
            add(next);
    }
    return walls;
}

double WallDrawing::length(Wall wall) const {
    const WallPiece& piece = states_[wall.chain].pieces[wall.piece];
    return static_cast<double>(piece.last - piece.first);
}

void WallDrawing::shift(Wall wall, double cells) {
    State& state = states_[wall.chain];
    ++state.shifts[wall.piece].times;
    state.shifts[wall.piece].cells += cells;
    state.waiting = true;
}

}  // namespace d2b
