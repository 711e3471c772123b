#include "outline/walls/wall_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/stop_token.hpp"
#include "outline/walls/chain_polyline.hpp"

namespace d2b::outline {

/// Divides a chain into walls by dynamic programming over its turning points. Minimizes the sum of a price
/// per wall and of squared distances, subject to every wall staying within the tolerance of its trace. Walls
/// in the dominant direction and at 90 degrees to it are cheapest; consecutive walls never share a direction.
/// O(steps), because a wall spans at most 64 points.
/// @param points steps at which the chain may turn
/// @param direction dominant direction in radians; adjusted to the walls that follow it
/// @return nullopt if there is no such division @throws Cancelled
[[nodiscard]] std::optional<std::vector<WallSegment>> plan_walls(const TraceSums& samples,
                                                                 std::vector<std::size_t> points,
                                                                 const WallParameters& parameters,
                                                                 double& direction, const StopToken& stop);

/// Replaces runs of walls that turn the same way by circular arcs if these are the cheaper description, and
/// all walls of a closed chain by a circle. Walls::automatic only. @throws Cancelled
void find_circular_arcs(const TraceSums& samples, const WallParameters& parameters,
                        std::vector<WallSegment>& segments, const StopToken& stop);

namespace {

constexpr double variance = WallParameters::variance;
constexpr std::size_t max_wall_span = 64;  // turning points that a wall may span
constexpr std::size_t families = WallSegment::free + 1;
constexpr std::array<double, families> prices{1.2, 1.2, 1.8, 1.8, 2.2};
constexpr std::size_t long_wall = 20;  // steps; the ends of shorter walls count as well
constexpr double infinite = std::numeric_limits<double>::infinity();

class Planner {
  public:
    Planner(const TraceSums& samples, const WallParameters& parameters, const StopToken& stop)
        : samples_(samples), parameters_(parameters), stop_(stop) {}
    /// @param points ascending steps; walls begin at the first and end at the last
    std::optional<std::vector<WallSegment>> plan(const std::vector<std::size_t>& points, double direction);

  private:
    struct State {
        double cost = infinite;
        std::uint32_t from = 0;
        std::uint8_t family = 0;  // family of the previous wall
        std::uint8_t before = 0;  // cheapest family of the previous wall for a wall of this family
    };
    using States = std::array<State, families>;
    using Costs = std::array<double, families>;

    void set_direction(double direction) {
        const double c = std::cos(direction);
        const double s = std::sin(direction);
        const double half = std::numbers::sqrt2 / 2;
        directions_ = {Vec2{c, s}, Vec2{-s, c}, half * Vec2{c - s, c + s}, half * Vec2{-c - s, c - s}};
    }
    [[nodiscard]] bool is_allowed(std::size_t family) const {
        const bool fixed = family < WallSegment::free;
        switch (parameters_.walls) {
            case Walls::right:
                return family < 2;
            case Walls::free:
                return !fixed;
            default:
                return true;
        }
    }
    [[nodiscard]] Line2 line(std::size_t family, const TraceSums::Sums& sums) const {
        return {sums.mean, family < WallSegment::free ? directions_[family] : sums.direction()};
    }
    [[nodiscard]] double misfit(std::size_t first, std::size_t last, const Line2& line, double squares) const;
    void find_before(std::size_t point);
    void begin_at(std::size_t point);
    void extend(std::size_t from, std::size_t to, const TraceSums::Sums& sums, double least);
    void extend(std::size_t from, std::size_t to, std::size_t family, const TraceSums::Sums& sums,
                double least);
    [[nodiscard]] std::vector<WallSegment> trace_back(const std::vector<std::size_t>& points) const;

    const TraceSums& samples_;
    WallParameters parameters_;
    const StopToken& stop_;
    std::array<Vec2, WallSegment::free> directions_{};
    const std::vector<std::size_t>* points_ = nullptr;
    std::vector<States> states_;
    std::vector<Costs>
        start_costs_;  // per point: cost of a wall of each family that starts there, without its misfit
};

/// Neighbours must not be parallel.
void Planner::find_before(std::size_t point) {
    States& states = states_[point];
    for (std::size_t family = 0; family < families; ++family) {
        std::uint8_t best = family == 0 ? 1 : 0;
        for (std::uint8_t f = 0; f < families; ++f)
            if ((f != family || f == WallSegment::free) && states[f].cost < states[best].cost)
                best = f;
        states[family].before = best;
    }
}

/// Misfit is free if the whole range except its ends is as close as the staircase of a straight wall.
double Planner::misfit(std::size_t first, std::size_t last, const Line2& line, double squares) const {
    const std::size_t ends = last - first < long_wall ? 0 : 2;
    const bool straight =
        samples_.near(first + ends, last - ends, line, parameters_.straightness_tolerance());
    return straight ? parameters_.misfit(squares, static_cast<double>(last - first)) : squares / variance;
}

/// Sets the cost of walls that begin at a point including all walls before them, without their misfit.
void Planner::begin_at(std::size_t point) {
    for (std::size_t f = 0; f < families; ++f) {
        const double before = point == 0 ? 0 : states_[point][states_[point][f].before].cost;
        start_costs_[point][f] = is_allowed(f) ? before + parameters_.price * prices[f] : infinite;
    }
}

/// @param least squares about the best line of any direction
void Planner::extend(std::size_t from, std::size_t to, const TraceSums::Sums& sums, double least) {
    const double misfit = parameters_.misfit(least, sums.n);
    const Costs& start_cost = start_costs_[from];
    const States& reached = states_[to];
    for (std::size_t f = 0; f < families; ++f)
        if (start_cost[f] + misfit < reached[f].cost)  // usually false
            extend(from, to, f, sums, least);
}

void Planner::extend(std::size_t from, std::size_t to, std::size_t family, const TraceSums::Sums& sums,
                     double least) {
    State& reached = states_[to][family];
    const double start_cost = start_costs_[from][family];
    const double squares = family < WallSegment::free ? sums.squares(directions_[family]) : least;
    if (!(start_cost + parameters_.misfit(squares, sums.n) < reached.cost))
        return;
    const Line2 along = line(family, sums);
    const double cost = start_cost + misfit((*points_)[from], (*points_)[to], along, squares);
    if (!(cost < reached.cost))
        return;
    const double limit = parameters_.tolerance - wall_clearance;
    if (samples_.near((*points_)[from], (*points_)[to], along, limit)) {
        reached.cost = cost;
        reached.from = static_cast<std::uint32_t>(from);
        reached.family = states_[from][family].before;
        reached.before = 0;
    }
}

std::vector<WallSegment> Planner::trace_back(const std::vector<std::size_t>& points) const {
    std::vector<WallSegment> segments;
    std::size_t to = points.size() - 1;
    std::size_t family = 0;
    for (std::size_t f = 1; f < families; ++f)
        if (states_[to][f].cost < states_[to][family].cost)
            family = f;
    while (to > 0) {
        const State& state = states_[to][family];
        const TraceSums::Sums sums = samples_.sums(points[state.from], points[to]);
        const double squares =
            family < WallSegment::free ? sums.squares(directions_[family]) : sums.least_squares();
        segments.push_back({points[state.from],
                            points[to],
                            static_cast<int>(family),
                            line(family, sums),
                            {},
                            parameters_.price * prices[family] +
                                misfit(points[state.from], points[to], line(family, sums), squares)});
        to = state.from;
        family = state.family;
    }
    std::reverse(segments.begin(), segments.end());
    return segments;
}

std::optional<std::vector<WallSegment>> Planner::plan(const std::vector<std::size_t>& points,
                                                      double direction) {
    set_direction(direction);
    points_ = &points;
    states_.assign(points.size(), {});
    start_costs_.resize(points.size());
    begin_at(0);
    for (std::size_t to = 1; to < points.size(); ++to) {
        stop_.check();
        for (std::size_t from = to; from-- > 0 && to - from <= max_wall_span;) {
            if (points[to] - points[from] > samples_.steps())
                break;
            const TraceSums::Sums sums = samples_.sums(points[from], points[to]);
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
double adjust_direction(double direction, const std::vector<WallSegment>& segments,
                        const TraceSums& samples) {
    constexpr double quarter = std::numbers::pi / 4;
    double sum = 0;
    double weights = 0;
    for (const WallSegment& segment : segments) {
        const TraceSums::Sums sums = samples.sums(segment.first, segment.last);
        if (segment.family >= 2 || sums.n < 4)
            continue;
        const Vec2 along = sums.direction();
        const double offset = std::atan2(along.y, along.x) - direction;
        const double rest = offset - std::round(offset / (2 * quarter)) * 2 * quarter;
        if (std::abs(rest) > 0.2)
            continue;
        const double weight = std::pow(sums.n, 3);
        sum += weight * rest;
        weights += weight;
    }
    return weights > 0 ? direction + sum / weights : direction;
}

/// Rotates the turning points of a closed chain to start at the sharpest corner.
std::vector<std::size_t> rotate_start(const std::vector<std::size_t>& points,
                                      const std::vector<WallSegment>& segments, std::size_t steps) {
    std::size_t start = segments.front().first;
    double largest = -1;
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const auto shorter =
            static_cast<double>(std::min({segments[i - 1].last - segments[i - 1].first,
                                          segments[i].last - segments[i].first, std::size_t{20}}));
        const double turn = std::abs(cross(segments[i - 1].line.along, segments[i].line.along)) * shorter;
        if (turn > largest) {
            largest = turn;
            start = segments[i].first;
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

std::optional<std::vector<WallSegment>> plan_walls(const TraceSums& samples, std::vector<std::size_t> points,
                                                   const WallParameters& parameters, double& direction,
                                                   const StopToken& stop) {
    if (samples.closed())
        points.push_back(samples.steps());
    Planner planner(samples, parameters, stop);
    std::optional<std::vector<WallSegment>> segments = planner.plan(points, direction);
    if (!segments || segments->size() < 2)
        return segments;
    direction = adjust_direction(direction, *segments, samples);
    if (samples.closed())
        points = rotate_start(points, *segments, samples.steps());
    std::optional<std::vector<WallSegment>> again = planner.plan(points, direction);
    return again ? again : segments;
}

namespace {

constexpr double arc_price = 3.2;  // cost of an arc: more than a wall, less than two
constexpr double max_cost_ratio =
    0.6;  // largest cost relative to that of the walls replaced, because ragged walls are not arcs
constexpr double min_radius = 3;  // cells
constexpr double min_sweep = std::numbers::pi / 2;
constexpr std::size_t min_walls = 4;  // fewest walls that an arc replaces

/// Returns an arc to replace a run of walls if it is the cheaper description.
std::optional<WallSegment> fit_arc(const TraceSums& samples, const WallParameters& parameters,
                                   std::size_t first, std::size_t last, double walls_cost) {
    const std::optional<Circle> circle = fit_circle(samples, first, last);
    if (!circle || circle->radius < min_radius)
        return {};
    double squares = 0;
    double largest = 0;
    for (std::size_t i = first; i < last; ++i) {
        squares += std::pow(circle->offset(0.5 * (samples.at(i) + samples.at(i + 1))), 2);
        largest = std::max(largest, std::abs(circle->offset(samples.at(i))));
        if (largest > parameters.tolerance - 0.05)
            return {};
    }
    const double cost =
        parameters.price * arc_price + parameters.misfit(squares, static_cast<double>(last - first));
    const double sweep =
        static_cast<double>(last - first) / 1.27 / circle->radius;  // a staircase is 4 / pi times longer
    if (cost > max_cost_ratio * walls_cost || sweep < min_sweep)
        return {};
    return WallSegment{first, last, WallSegment::free, {}, circle, cost};
}

/// Direction of the turn between two walls: 1 or -1, or 0 if the turn is too sharp or too slight for an arc.
int turn(const WallSegment& a, const WallSegment& b) {
    const Vec2 from = a.line.along;
    const Vec2 to = b.line.along;
    const double sine = cross(from, to);
    if (dot(from, to) < std::cos(std::numbers::pi / 3) || std::abs(sine) < 0.02)
        return 0;
    return sine > 0 ? 1 : -1;
}

/// Returns the end of the longest run of walls from i that turn the same way, limited to one and a half
/// turns: no arc is longer, and a spiral would otherwise be searched to its end from each of its walls.
std::size_t end_of_turn(const std::vector<WallSegment>& segments, std::size_t i) {
    constexpr double most = 3 * std::numbers::pi;
    std::size_t end = i + 1;
    for (double angle = 0; end < segments.size() && angle < most; ++end) {
        const int way = turn(segments[end - 1], segments[end]);
        if (way == 0 || way != turn(segments[i], segments[i + 1]))
            break;
        angle +=
            std::asin(std::min(1.0, std::abs(cross(segments[end - 1].line.along, segments[end].line.along))));
    }
    return end;
}

}  // namespace

void find_circular_arcs(const TraceSums& samples, const WallParameters& parameters,
                        std::vector<WallSegment>& segments, const StopToken& stop) {
    if (parameters.walls != Walls::automatic || segments.size() < min_walls)
        return;
    double cost = 0;
    for (const WallSegment& segment : segments)
        cost += segment.cost;
    if (samples.closed())
        if (const auto circle = fit_arc(samples, parameters, segments.front().first,
                                        segments.front().first + samples.steps(), cost)) {
            segments = {*circle};
            return;
        }
    std::vector<WallSegment> result;
    for (std::size_t i = 0; i < segments.size();) {
        std::size_t end = end_of_turn(segments, i);
        std::optional<WallSegment> arc;
        for (; !arc && end >= i + min_walls; --end) {
            stop.check();
            double replaced = 0;
            for (std::size_t k = i; k < end; ++k)
                replaced += segments[k].cost;
            arc = fit_arc(samples, parameters, segments[i].first, segments[end - 1].last, replaced);
            if (arc)
                break;
        }
        result.push_back(arc ? *arc : segments[i]);
        i = arc ? end : i + 1;
    }
    segments = std::move(result);
}

void shift_wall(WallSegment& segment, const TraceSums& samples, double cells) {
    const Vec2 run = samples.at(segment.last) - samples.at(segment.first);
    if (segment.circle) {
        const Vec2 middle = samples.at((segment.first + segment.last) / 2) - segment.circle->centre;
        const bool whole = segment.last - segment.first == samples.steps();
        const bool counter_clockwise = whole ? twice_area(samples) > 0 : cross(middle, run) > 0;
        segment.circle->radius += counter_clockwise != samples.mirrored() ? -cells : cells;
        return;
    }
    const double sign = dot(run, segment.line.along) > 0 ? 1 : -1;
    segment.line.through = segment.line.through + sign * cells * samples.left_of(segment.line.along);
}

void move_inward(const TraceSums& samples, int higher, double cells, double limit,
                 std::vector<WallSegment>& segments) {
    for (WallSegment& segment : segments)
        for (int quarters = 4; quarters > 0; --quarters) {
            WallSegment moved = segment;
            shift_wall(moved, samples, higher * quarters * cells / 4);
            if (!segment.circle && !samples.near(segment.first, segment.last, moved.line, limit))
                continue;
            segment = moved;
            break;
        }
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_move = 0.5;         // cells
constexpr double clearance = 1.0 / 256;  // cells between a wall and the center of a cell

/// Cost of a cell of lower ground on the side of a building or tier, relative to a cost of 1 for a cell that
/// it loses. The costs differ because outlines from elevations tend to be too wide. In a synthetic scene,
/// walls are 0.01 cells too far out if both costs are 1, and as much too far in if this one is 3.
constexpr double low_cell_cost = 2.25;

/// Offset at which a wall moving to the left passes the center of a cell.
struct CrossingEvent {
    double at = 0;
    double cost = 0;  ///< negative if the cell moves to its correct side
};

class Separator {
  public:
    Separator(const TraceSums& samples, int higher)
        : samples_(samples),
          left_cost_(higher < 0 ? low_cell_cost : 1),
          right_cost_(higher > 0 ? low_cell_cost : 1) {}
    /// @return cells to the left of the direction of the chain
    double move(const WallSegment& segment) {
        find_events(segment);
        return cheapest();
    }

  private:
    void find_events(const WallSegment& segment);
    [[nodiscard]] double cheapest() const;

    const TraceSums& samples_;
    double left_cost_;
    double right_cost_;
    std::vector<CrossingEvent> events_;
};

/// Counts a cell shared by consecutive steps once.
void Separator::find_events(const WallSegment& segment) {
    events_.clear();
    const Vec2 run = samples_.at(segment.last) - samples_.at(segment.first);
    const Vec2 left = (dot(run, segment.line.along) > 0 ? 1 : -1) * samples_.left_of(segment.line.along);
    TraceSums::Cells before{{infinity, infinity}, {infinity, infinity}};
    const auto add = [&](Vec2 cell, Vec2 cell_before, double cost) {
        if (!(length(cell - cell_before) < 0.1))
            events_.push_back({dot(left, cell - segment.line.through), cost});
    };
    for (std::size_t step = segment.first; step < segment.last; ++step) {
        const TraceSums::Cells cells = samples_.adjacent_cells(step);
        add(cells.left, before.left, left_cost_);
        add(cells.right, before.right, -right_cost_);
        before = cells;
    }
    std::ranges::sort(events_, {}, &CrossingEvent::at);
}

double Separator::cheapest() const {
    double cost = 0;
    double least = infinity;
    double best = 0;
    const auto consider = [&](double from, double to) {
        const double low = std::max(from + clearance, -max_move);
        const double high = std::min(to - clearance, max_move);
        if (low > high)
            return;
        const double move = std::clamp(0.0, low, high);
        if (cost < least || (cost == least && std::abs(move) < std::abs(best))) {
            least = cost;
            best = move;
        }
    };
    double from = -infinity;
    for (const CrossingEvent& event : events_) {
        consider(from, event.at);
        cost += event.cost;
        from = event.at;
    }
    consider(from, infinity);
    return best;
}

}  // namespace

void separate_cells(const TraceSums& samples, int higher, double limit, std::vector<WallSegment>& segments) {
    Separator separator(samples, higher);
    for (WallSegment& segment : segments) {
        if (segment.circle)
            continue;
        WallSegment moved = segment;
        shift_wall(moved, samples, separator.move(segment));
        if (samples.near(segment.first, segment.last, moved.line, limit))
            segment.line = moved.line;
    }
}

WallSegment ChainWalls::segment(std::size_t i) const {
    WallSegment segment = segments_[i];
    if (shifts_[i].cells != 0)
        shift_wall(segment, samples_, shifts_[i].cells);
    return segment;
}

std::vector<WallSegment> ChainWalls::segments() const {
    std::vector<WallSegment> result;
    result.reserve(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i)
        result.push_back(segment(i));
    return result;
}

bool ChainWalls::plan(const std::vector<std::size_t>& points, const WallParameters& parameters,
                      double& direction, const StopToken& stop) {
    std::optional<std::vector<WallSegment>> segments =
        plan_walls(samples_, points, parameters, direction, stop);
    if (!segments)
        return false;
    find_circular_arcs(samples_, parameters, *segments, stop);
    refine_breakpoints(samples_, *segments);
    const double limit = parameters.tolerance - wall_clearance;
    separate_cells(samples_, higher_, limit, *segments);
    if (parameters.inset > 0)
        move_inward(samples_, higher_, parameters.inset, limit, *segments);
    segments_ = std::move(*segments);
    shifts_.assign(segments_.size(), {});
    return true;
}

std::vector<std::size_t> ChainWalls::movable_walls(std::size_t begin, std::size_t end,
                                                   const StopToken& stop) const {
    constexpr int most_shifts = 10;
    constexpr double most = 0.7;
    const bool closed = samples_.closed();
    const std::size_t round = samples_.steps();
    std::vector<std::size_t> walls;
    const auto add = [&](std::size_t i) {
        stop.check();
        const WallSegment& segment = segments_[i];
        const auto common = [&](std::size_t arc_round, std::size_t piece_round) {
            const std::size_t first = std::max(begin + arc_round, segment.first + piece_round);
            const std::size_t last = std::min(end + arc_round, segment.last + piece_round);
            return last > first ? last - first : 0;
        };
        const std::size_t within = common(0, 0) + (closed ? common(round, 0) + common(0, round) : 0);
        if (shifts_[i].times < most_shifts && static_cast<double>(within) >= most * length(i))
            walls.push_back(i);
    };
    // Both ranges of a closed chain may wrap around. Walls are in order along the chain.
    std::size_t next = 0;
    for (std::size_t lap = closed ? 0 : 1; lap < (closed ? 3 : 2); ++lap) {
        const auto ends_after = [&](const WallSegment& segment) {
            return segment.last + round > begin + lap * round;
        };
        const auto begins_before = [&](const WallSegment& segment) {
            return segment.first + round < end + lap * round;
        };
        const auto low = std::ranges::partition_point(segments_, std::not_fn(ends_after));
        const auto high = std::ranges::partition_point(segments_, begins_before);
        next = std::max(next, static_cast<std::size_t>(low - segments_.begin()));
        for (; next < static_cast<std::size_t>(high - segments_.begin()); ++next)
            add(next);
    }
    return walls;
}

}  // namespace d2b::outline
