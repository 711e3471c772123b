#include "outline/walls/wall_segmentation.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "outline/walls/chain_polyline.hpp"
#include "outline/walls/frame_walls.hpp"
#include "outline/walls/wall_adjustment.hpp"
#include "outline/walls/wall_path.hpp"

namespace d2b::outline {

namespace {

/// Rectangle with the area, the centroid and the proportions of a closed chain, for rings too small for a
/// path.
/// @param frame direction of its sides in radians
/// @return nullopt if its corners are not near four steps in the order of the chain
std::optional<std::vector<WallSegment>> fit_rectangle(const TraceSums& samples, double frame) {
    const Vec2 u{std::cos(frame), std::sin(frame)};
    const Vec2 v{-u.y, u.x};
    // Area and moments of the ring in the frame, by Green's theorem.
    double twice = 0;
    Vec2 first;
    Vec2 second;
    for (std::size_t i = 0; i < samples.steps(); ++i) {
        const Vec2 a{dot(samples.at(i), u), dot(samples.at(i), v)};
        const Vec2 b{dot(samples.at(i + 1), u), dot(samples.at(i + 1), v)};
        const double part = cross(a, b);
        twice += part;
        first = first + part * (a + b);
        second = second + part * Vec2{a.x * a.x + a.x * b.x + b.x * b.x, a.y * a.y + a.y * b.y + b.y * b.y};
    }
    const double area = twice / 2;
    const Vec2 centre = 1 / (3 * twice) * first;
    const double variance_u = second.x / (12 * area) - centre.x * centre.x;
    const double variance_v = second.y / (12 * area) - centre.y * centre.y;
    if (!(variance_u > 0) || !(variance_v > 0))
        return {};
    const double proportion = std::sqrt(std::sqrt(variance_u / variance_v));
    const double half = std::sqrt(std::abs(area)) / 2;
    const double half_u = half * proportion;
    const double half_v = half / proportion;
    // The corners in the order of the chain, and the steps nearest to them.
    const double way = area > 0 ? 1 : -1;
    std::array<std::size_t, 4> steps{};
    std::array<Vec2, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        const double along = k == 1 || k == 2 ? half_u : -half_u;
        const double across = way * (k >= 2 ? half_v : -half_v);
        corners[k] = (centre.x + along) * u + (centre.y + across) * v;
        for (std::size_t i = 1; i < samples.steps(); ++i)
            if (length(samples.at(i) - corners[k]) < length(samples.at(steps[k]) - corners[k]))
                steps[k] = i;
    }
    const auto begin = static_cast<std::size_t>(std::ranges::min_element(steps) - steps.begin());
    std::vector<WallSegment> walls;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (begin + i) % 4;
        const std::size_t next = (k + 1) % 4;
        const std::size_t last = i < 3 ? steps[next] : steps[begin] + samples.steps();
        if (last <= steps[k])
            return {};
        const Vec2 side = corners[next] - corners[k];
        walls.push_back({steps[k], last, 0, {corners[k], 1 / length(side) * side}, {}});
    }
    return walls;
}

constexpr double chord_price = 2.2;        // cost of a straight stretch
constexpr double max_arc_distance = 1.25;  // cells
constexpr double arc_price = 3.2;          // cost of an arc: more than a stretch, less than two
constexpr double max_cost_ratio =
    0.6;  // largest cost relative to that of the stretches replaced, because ragged walls are not arcs
constexpr double min_radius = 3;  // cells
constexpr double min_sweep = std::numbers::pi / 2;
constexpr double max_sweep = 10 * std::numbers::pi / 9;  // crowns beside a house turn farther
constexpr double sweep_of_any_radius = 5 * std::numbers::pi / 6;
constexpr double min_corner_distance =
    0.6;  // of the corner that a quarter of a circle rounds off, in tolerances
constexpr std::size_t min_stretches = 4;  // fewest stretches that an arc replaces

/// A stretch of the trace between two turning points.
struct PricedStretch {
    std::size_t first;
    std::size_t last;
    Vec2 along;
    double cost;
    bool on_frame = false;  // of the raster, which cuts arcs off
};

/// Stretches of a chain; those of a closed one begin at the sharpest corner, because no arc contains it.
std::vector<PricedStretch> stretches_of(const TraceSums& samples, const std::vector<std::size_t>& points,
                                        const std::vector<WallSegment>& on_frame,
                                        const WallParameters& parameters) {
    std::vector<PricedStretch> stretches;
    for (std::size_t i = 0; i + (samples.closed() ? 0 : 1) < points.size(); ++i) {
        const std::size_t last = i + 1 < points.size() ? points[i + 1] : samples.steps();
        const TraceSums::Sums sums = samples.sums(points[i], last);
        const Vec2 along = sums.direction();
        const Vec2 run = samples.at(last) - samples.at(points[i]);
        stretches.push_back({points[i], last, dot(run, along) < 0 ? -1 * along : along,
                             chord_price + parameters.misfit(sums.least_squares(), sums.n),
                             is_on(on_frame, points[i], last)});
    }
    if (!samples.closed())
        return stretches;
    const std::size_t n = stretches.size();
    std::size_t start = 0;
    double largest = -1;
    for (std::size_t i = 0; i < n; ++i) {
        const PricedStretch& before = stretches[(i + n - 1) % n];
        const auto shorter = static_cast<double>(
            std::min({before.last - before.first, stretches[i].last - stretches[i].first, std::size_t{20}}));
        const double turn = std::abs(cross(before.along, stretches[i].along)) * shorter;
        if (turn > largest) {
            largest = turn;
            start = i;
        }
    }
    std::rotate(stretches.begin(), stretches.begin() + static_cast<std::ptrdiff_t>(start), stretches.end());
    for (std::size_t i = n - start; i < n; ++i) {
        stretches[i].first += samples.steps();
        stretches[i].last += samples.steps();
    }
    return stretches;
}

/// Sum of the squared distances of the midpoints of steps from a line or circle.
template <typename Shape>
double squares_from(const Shape& shape, const TraceSums& samples, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t step = first; step < last; ++step)
        sum += std::pow(shape.offset(samples.midpoint(step)), 2);
    return sum;
}

/// Returns an arc to replace a run of stretches if it is the cheaper description.
std::optional<WallSegment> fit_arc(const TraceSums& samples, const WallParameters& parameters,
                                   std::size_t first, std::size_t last, double replaced_cost) {
    const std::optional<Circle> circle = fit_circle(samples, first, last);
    if (!circle || circle->radius < min_radius)
        return {};
    const double limit = std::min(parameters.tolerance, max_arc_distance) - wall_clearance;
    for (std::size_t i = first; i < last; ++i)
        if (std::abs(circle->offset(samples.at(i))) > limit)
            return {};
    const double cost = arc_price + parameters.misfit(squares_from(*circle, samples, first, last),
                                                      static_cast<double>(last - first));
    const double sweep =
        static_cast<double>(last - first) / 1.27 / circle->radius;  // a staircase is 4 / pi times longer
    const bool whole = samples.closed() && last - first == samples.steps();
    if (cost > max_cost_ratio * replaced_cost || sweep < min_sweep || (!whole && sweep > max_sweep))
        return {};
    // Crowns round off the corners of houses as well.
    if (sweep < sweep_of_any_radius &&
        (std::numbers::sqrt2 - 1) * circle->radius < min_corner_distance * parameters.tolerance)
        return {};
    return WallSegment{first, last, 0, {}, circle};
}

/// True if a rectangle in some direction lies nearer to a ring than a circle: a square house without its
/// corners would be round otherwise.
bool is_rather_rectangle(const TraceSums& samples, const Circle& circle) {
    constexpr int directions = 18;
    const double round = squares_from(circle, samples, 0, samples.steps());
    for (int i = 0; i < directions; ++i) {
        const auto rectangle = fit_rectangle(samples, i * std::numbers::pi / 2 / directions);
        if (!rectangle)
            continue;
        double squares = 0;
        for (const WallSegment& side : *rectangle)
            squares += squares_from(side.line, samples, side.first, side.last);
        if (squares < round)
            return true;
    }
    return false;
}

/// Direction of the turn between two stretches: 1 or -1, or 0 if the turn is too sharp or too slight for an
/// arc.
int turn(const PricedStretch& a, const PricedStretch& b) {
    const double sine = cross(a.along, b.along);
    if (a.on_frame || b.on_frame || dot(a.along, b.along) < std::cos(std::numbers::pi / 3) ||
        std::abs(sine) < 0.02)
        return 0;
    return sine > 0 ? 1 : -1;
}

/// Returns the end of the longest run of stretches from i that turn the same way, limited to one and a half
/// turns: no arc is longer, and a spiral would otherwise be searched to its end from each of its stretches.
std::size_t end_of_turn(const std::vector<PricedStretch>& stretches, std::size_t i) {
    constexpr double most = 3 * std::numbers::pi;
    std::size_t end = i + 1;
    for (double angle = 0; end < stretches.size() && angle < most; ++end) {
        const int way = turn(stretches[end - 1], stretches[end]);
        if (way == 0 || way != turn(stretches[i], stretches[i + 1]))
            break;
        angle += std::asin(std::min(1.0, std::abs(cross(stretches[end - 1].along, stretches[end].along))));
    }
    return end;
}

/// True if a stretch continues an arc or is at a right angle to its end, as walls are; crowns join houses at
/// any angle.
bool joins(const TraceSums& samples, const WallSegment& arc, const PricedStretch& stretch, bool at_end) {
    constexpr double max_error = 20.0 / 180 * std::numbers::pi;
    if (stretch.on_frame)
        return true;
    const Vec2 spoke = samples.at(at_end ? arc.last : arc.first) - arc.circle->centre;
    const double size = length(spoke);
    const double sine =
        std::abs(dot(spoke, stretch.along)) / size;  // of the angle between tangent and stretch
    const double angle = std::asin(std::min(1.0, sine));
    return angle < max_error || angle > std::numbers::pi / 2 - max_error;
}

/// Longest arc that begins with a stretch. @param end of the run of stretches, set to that of the arc
std::optional<WallSegment> longest_arc(const TraceSums& samples, const WallParameters& parameters,
                                       const std::vector<PricedStretch>& stretches, std::size_t begin,
                                       std::size_t& end, const StopToken& stop) {
    for (; end >= begin + min_stretches; --end) {
        stop.check();
        double replaced = 0;
        for (std::size_t k = begin; k < end; ++k)
            replaced += stretches[k].cost;
        if (const auto arc =
                fit_arc(samples, parameters, stretches[begin].first, stretches[end - 1].last, replaced))
            return arc;
    }
    return {};
}

/// Finds circular arcs among the stretches of a chain: where a run of them that turn the same way is
/// described more cheaply by an arc. Walls::automatic only. @throws Cancelled
std::vector<WallSegment> find_circular_arcs(const TraceSums& samples, const std::vector<std::size_t>& points,
                                            const std::vector<WallSegment>& on_frame,
                                            const WallParameters& parameters, const StopToken& stop) {
    if (parameters.walls != Walls::automatic || points.size() < min_stretches)
        return {};
    const std::vector<PricedStretch> stretches = stretches_of(samples, points, on_frame, parameters);
    double cost = 0;
    for (const PricedStretch& stretch : stretches)
        cost += stretch.cost;
    if (samples.closed() && on_frame.empty())
        if (const auto ring = fit_arc(samples, parameters, 0, samples.steps(), cost);
            ring && !is_rather_rectangle(samples, *ring->circle))
            return {*ring};
    std::vector<WallSegment> arcs;
    for (std::size_t i = 0; i < stretches.size();) {
        std::size_t end = end_of_turn(stretches, i);
        const std::optional<WallSegment> arc = longest_arc(samples, parameters, stretches, i, end, stop);
        const std::size_t n = stretches.size();
        const bool joined =
            arc &&
            ((!samples.closed() && i == 0) || joins(samples, *arc, stretches[(i + n - 1) % n], false)) &&
            ((!samples.closed() && end == n) || joins(samples, *arc, stretches[end % n], true));
        if (joined)
            arcs.push_back(*arc);
        i = arc ? end : i + 1;
    }
    for (WallSegment& arc : arcs)
        if (arc.first >= samples.steps()) {
            arc.first -= samples.steps();
            arc.last -= samples.steps();
        }
    return arcs;
}

constexpr std::size_t min_wedge_steps = 8;  // of the walls of a triangle; smaller ones are not houses

/// Walls of a chain between its known segments: arcs, and walls on the frame. A ring too small for that
/// becomes a rectangle.
std::optional<std::vector<WallSegment>> divide(const TraceSums& samples,
                                               const std::vector<std::size_t>& points,
                                               const std::vector<WallSegment>& known,
                                               const WallParameters& parameters,
                                               const WallDirections& directions, const StopToken& stop) {
    const auto walls = [&](std::size_t first, std::size_t last) {
        return find_walls(samples, first, last, points, parameters, directions, stop);
    };
    if (known.empty()) {
        std::optional<std::vector<WallSegment>> found = walls(0, samples.steps());
        const auto is_short = [](const WallSegment& wall) {
            return wall.last - wall.first < min_wedge_steps;
        };
        if (samples.closed() && (!found || (found->size() < 4 && std::ranges::any_of(*found, is_short))))
            if (auto rectangle = fit_rectangle(samples, directions.frames.front()))
                return rectangle;
        return found;
    }
    std::vector<WallSegment> result;
    const auto add = [&](std::size_t first, std::size_t last) {
        if (first == last)
            return true;
        const std::optional<std::vector<WallSegment>> found = walls(first, last);
        if (found)
            result.insert(result.end(), found->begin(), found->end());
        return found.has_value();
    };
    bool all = samples.closed() || add(0, known.front().first);
    for (std::size_t i = 0; i < known.size() && all; ++i) {
        result.push_back(known[i]);
        const bool last = i + 1 == known.size();
        const std::size_t end = samples.closed() ? known.front().first + samples.steps() : samples.steps();
        all = add(known[i].last, last ? end : known[i + 1].first);
    }
    return all ? std::optional(result) : std::nullopt;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_move = 0.25;        // cells
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
          right_cost_(higher > 0 ? low_cell_cost : 1) {
        events_.reserve(2 * samples.steps());
    }
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
        const Vec2 apart = cell - cell_before;
        if (!(dot(apart, apart) < 0.01))
            events_.push_back({dot(left, cell - segment.line.through), cost});
    };
    for (std::size_t step = segment.first; step < segment.last; ++step) {
        // Bays and corners that the wall cuts off say nothing about its position.
        const Vec2 along = samples_.at(step + 1) - samples_.at(step);
        if (std::abs(segment.line.offset(samples_.midpoint(step))) > max_move + 0.5 ||
            dot(along, segment.line.along) * dot(run, segment.line.along) <= 0)
            continue;
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
            if (segment.on_frame ||
                (!segment.circle && !samples.near(segment.first, segment.last, moved.line, limit)))
                continue;
            segment = moved;
            break;
        }
}

void separate_cells(const TraceSums& samples, int higher, double limit, std::vector<WallSegment>& segments) {
    Separator separator(samples, higher);
    for (WallSegment& segment : segments) {
        if (!segment.is_wall())
            continue;
        WallSegment moved = segment;
        shift_wall(moved, samples, separator.move(segment));
        if (samples.near(segment.first, segment.last, moved.line, limit))
            segment.line = moved.line;
    }
}

ChainWalls::ChainWalls(const Chain& chain, const WallOptions& options)
    : samples_(chain.trace, chain.closed, options.shape) {
    if (options.frame && options.walls != Walls::right)
        on_frame_ = walls_on_frame(chain, samples_, *options.frame);
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
                      WallDirections& directions, bool turn_frames, const StopToken& stop) {
    constexpr double slight = 2 * degree;  // frames that turn by less have the same walls
    constexpr double negligible = 0.1 * degree;
    constexpr int most_rounds = 3;
    std::vector<WallSegment> known = find_circular_arcs(samples_, points, on_frame_, parameters, stop);
    known.insert(known.end(), on_frame_.begin(), on_frame_.end());
    std::ranges::sort(known, {}, &WallSegment::first);
    auto segments = divide(samples_, points, known, parameters, directions, stop);
    if (!segments)
        return false;
    for (int round = 0; turn_frames && round < most_rounds; ++round) {
        WallDirections turned = directions;
        const double turn = adjust_frames(samples_, *segments, turned);
        if (turn < slight)
            turn_walls(samples_, directions, turned, *segments);
        else if (auto again = divide(samples_, points, known, parameters, turned, stop))
            segments = std::move(again);
        else
            break;
        directions = std::move(turned);
        if (turn < negligible)
            break;
    }
    if (parameters.walls != Walls::right)
        join_parallel_walls(samples_, parameters, *segments);
    const double limit = parameters.tolerance - wall_clearance;
    separate_cells(samples_, parameters.higher, limit, *segments);
    if (parameters.inset > 0)
        move_inward(samples_, parameters.higher, parameters.inset, limit, *segments);
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
        if (!segment.on_frame && shifts_[i].times < most_shifts &&
            static_cast<double>(within) >= most * length(i))
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
