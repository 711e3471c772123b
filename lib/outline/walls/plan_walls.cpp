#include "outline/walls/plan_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace d2b {
namespace {

constexpr double variance = WallStyle::variance;
constexpr std::size_t window = 64;  // turning points that a wall may span
constexpr std::size_t families = WallPiece::free + 1;
constexpr std::array<double, families> prices{1.2, 1.2, 1.8, 1.8, 2.2};
constexpr std::size_t long_wall = 20;  // steps; the ends of shorter walls count as well
constexpr double infinite = std::numeric_limits<double>::infinity();

class Planner {
  public:
    Planner(const WallSamples& samples, const WallStyle& style, const StopRequest& stop)
        : samples_(samples), style_(style), stop_(stop) {}
    /// @param points ascending steps; walls begin at the first and end at the last
    std::optional<std::vector<WallPiece>> plan(const std::vector<std::size_t>& points, double direction);

  private:
    struct State {
        double cost = infinite;
        std::uint32_t from = 0;
        std::uint8_t family = 0;  // family of the previous wall
        std::uint8_t before = 0;  // cheapest family of the previous wall for a wall of this family
    };
    using States = std::array<State, families>;
    using Costs = std::array<double, families>;

    void turn_to(double direction) {
        const double c = std::cos(direction);
        const double s = std::sin(direction);
        const double half = std::numbers::sqrt2 / 2;
        directions_ = {Vec{c, s}, Vec{-s, c}, half * Vec{c - s, c + s}, half * Vec{-c - s, c - s}};
    }
    [[nodiscard]] bool allowed(std::size_t family) const {
        const bool fixed = family < WallPiece::free;
        switch (style_.walls) {
            case Walls::right:
                return family < 2;
            case Walls::free:
                return !fixed;
            default:
                return true;
        }
    }
    [[nodiscard]] Line line(std::size_t family, const WallSamples::Sums& sums) const {
        return {sums.mean, family < WallPiece::free ? directions_[family] : sums.direction()};
    }
    [[nodiscard]] double misfit(std::size_t first, std::size_t last, const Line& line, double squares) const;
    void find_before(std::size_t point);
    void begin_at(std::size_t point);
    void extend(std::size_t from, std::size_t to, const WallSamples::Sums& sums, double least);
    void extend(std::size_t from, std::size_t to, std::size_t family, const WallSamples::Sums& sums,
                double least);
    [[nodiscard]] std::vector<WallPiece> trace_back(const std::vector<std::size_t>& points) const;

    const WallSamples& samples_;
    WallStyle style_;
    const StopRequest& stop_;
    std::array<Vec, WallPiece::free> directions_{};
    const std::vector<std::size_t>* points_ = nullptr;
    std::vector<States> states_;
    std::vector<Costs>
        spent_;  // per point: cost of a wall of each family that starts there, without its misfit
};

/// Neighbours must not be parallel.
void Planner::find_before(std::size_t point) {
    States& states = states_[point];
    for (std::size_t family = 0; family < families; ++family) {
        std::uint8_t best = family == 0 ? 1 : 0;
        for (std::uint8_t f = 0; f < families; ++f)
            if ((f != family || f == WallPiece::free) && states[f].cost < states[best].cost)
                best = f;
        states[family].before = best;
    }
}

/// Misfit is free if the whole range except its ends is as close as the staircase of a straight wall.
double Planner::misfit(std::size_t first, std::size_t last, const Line& line, double squares) const {
    const std::size_t ends = last - first < long_wall ? 0 : 2;
    const bool straight = samples_.near(first + ends, last - ends, line, style_.straight_reach());
    return straight ? style_.misfit(squares, static_cast<double>(last - first)) : squares / variance;
}

/// Sets the cost of walls that begin at a point including all walls before them, without their misfit.
void Planner::begin_at(std::size_t point) {
    for (std::size_t f = 0; f < families; ++f) {
        const double before = point == 0 ? 0 : states_[point][states_[point][f].before].cost;
        spent_[point][f] = allowed(f) ? before + style_.price * prices[f] : infinite;
    }
}

/// @param least squares about the best line of any direction
void Planner::extend(std::size_t from, std::size_t to, const WallSamples::Sums& sums, double least) {
    const double misfit = style_.misfit(least, sums.n);
    const Costs& spent = spent_[from];
    const States& reached = states_[to];
    for (std::size_t f = 0; f < families; ++f)
        if (spent[f] + misfit < reached[f].cost)  // usually false
            extend(from, to, f, sums, least);
}

void Planner::extend(std::size_t from, std::size_t to, std::size_t family, const WallSamples::Sums& sums,
                     double least) {
    State& reached = states_[to][family];
    const double spent = spent_[from][family];
    const double squares = family < WallPiece::free ? sums.squares(directions_[family]) : least;
    if (!(spent + style_.misfit(squares, sums.n) < reached.cost))
        return;
    const Line along = line(family, sums);
    const double cost = spent + misfit((*points_)[from], (*points_)[to], along, squares);
    if (!(cost < reached.cost))
        return;
    const double limit = style_.tolerance - wall_clearance;
    if (samples_.near((*points_)[from], (*points_)[to], along, limit)) {
        reached.cost = cost;
        reached.from = static_cast<std::uint32_t>(from);
        reached.family = states_[from][family].before;
        reached.before = 0;
    }
}

std::vector<WallPiece> Planner::trace_back(const std::vector<std::size_t>& points) const {
    std::vector<WallPiece> pieces;
    std::size_t to = points.size() - 1;
    std::size_t family = 0;
    for (std::size_t f = 1; f < families; ++f)
        if (states_[to][f].cost < states_[to][family].cost)
            family = f;
    while (to > 0) {
        const State& state = states_[to][family];
        const WallSamples::Sums sums = samples_.sums(points[state.from], points[to]);
        const double squares =
            family < WallPiece::free ? sums.squares(directions_[family]) : sums.least_squares();
        pieces.push_back({points[state.from],
                          points[to],
                          static_cast<int>(family),
                          line(family, sums),
                          {},
                          style_.price * prices[family] +
                              misfit(points[state.from], points[to], line(family, sums), squares)});
        to = state.from;
        family = state.family;
    }
    std::reverse(pieces.begin(), pieces.end());
    return pieces;
}

std::optional<std::vector<WallPiece>> Planner::plan(const std::vector<std::size_t>& points,
                                                    double direction) {
    turn_to(direction);
    points_ = &points;
    states_.assign(points.size(), {});
    spent_.resize(points.size());
    begin_at(0);
    for (std::size_t to = 1; to < points.size(); ++to) {
        stop_.check();
        for (std::size_t from = to; from-- > 0 && to - from <= window;) {
            if (points[to] - points[from] > samples_.steps())
                break;
            const WallSamples::Sums sums = samples_.sums(points[from], points[to]);
            const double least = sums.least_squares();
            // Stop because walls between all points in between would be cheaper, and even more so from
            // farther back.
            if (least / variance > 12.0 * static_cast<double>(to - from) + 60)
                break;
            extend(from, to, sums, least);
        }
        find_before(to);
        begin_at(to);
    }
    const States& last = states_.back();
    if (std::ranges::all_of(last, [](const State& state) { return state.cost == infinite; }))
        return {};
    return trace_back(points);
}

/// Adjusts the dominant direction to the walls along it and at 90 degrees to it.
double adjusted(double direction, const std::vector<WallPiece>& pieces, const WallSamples& samples) {
    constexpr double quarter = std::numbers::pi / 4;
    double sum = 0;
    double weights = 0;
    for (const WallPiece& piece : pieces) {
        const WallSamples::Sums sums = samples.sums(piece.first, piece.last);
        if (piece.family >= 2 || sums.n < 4)
            continue;
        const Vec along = sums.direction();
        const double off = std::atan2(along.y, along.x) - direction;
        const double rest = off - std::round(off / (2 * quarter)) * 2 * quarter;
        if (std::abs(rest) > 0.2)
            continue;
        const double weight = std::pow(sums.n, 3);
        sum += weight * rest;
        weights += weight;
    }
    return weights > 0 ? direction + sum / weights : direction;
}

/// Rotates the turning points of a closed chain to start at the sharpest corner.
std::vector<std::size_t> restarted(const std::vector<std::size_t>& points,
                                   const std::vector<WallPiece>& pieces, std::size_t steps) {
    std::size_t start = pieces.front().first;
    double largest = -1;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const auto shorter = static_cast<double>(std::min(
            {pieces[i - 1].last - pieces[i - 1].first, pieces[i].last - pieces[i].first, std::size_t{20}}));
        const double turn = std::abs(cross(pieces[i - 1].line.along, pieces[i].line.along)) * shorter;
        if (turn > largest) {
            largest = turn;
            start = pieces[i].first;
        }
    }
    start %= steps;
    std::vector<std::size_t> result;
    for (const std::size_t point : points)
        if (point % steps >= start && point < steps)
            result.push_back(point);
    for (const std::size_t point : points)
        if (point % steps < start && point < steps)
            result.push_back(point + steps);
    result.push_back(start + steps);
    return result;
}

}  // namespace

std::optional<std::vector<WallPiece>> plan_walls(const WallSamples& samples, std::vector<std::size_t> points,
                                                 const WallStyle& style, double& direction,
                                                 const StopRequest& stop) {
    if (samples.closed())
        points.push_back(samples.steps());
    Planner planner(samples, style, stop);
    std::optional<std::vector<WallPiece>> pieces = planner.plan(points, direction);
    if (!pieces || pieces->size() < 2)
        return pieces;
    direction = adjusted(direction, *pieces, samples);
    if (samples.closed())
        points = restarted(points, *pieces, samples.steps());
    std::optional<std::vector<WallPiece>> again = planner.plan(points, direction);
    return again ? again : pieces;
}

}  // namespace d2b
