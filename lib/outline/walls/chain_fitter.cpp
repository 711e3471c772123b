#include "outline/walls/chain_fitter.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "outline/walls/frame_walls.hpp"

namespace d2b::outline {

namespace {

constexpr std::size_t min_wall_steps = 4;  // fewest steps of a wall between stretches of closer modes

FitMode next(FitMode mode) {
    return mode == FitMode::beveled ? mode : static_cast<FitMode>(static_cast<int>(mode) + 1);
}

constexpr double midpoint_tolerance = 0.6;  // cells
constexpr double tight_tolerance = 0.45;    // cells
constexpr std::size_t max_chord_span = 64;  // candidates that an edge may span
constexpr std::size_t max_failures = 8;     // consecutive edges that do not fit before the search stops
constexpr double vertex_cost = 20;          // square cells: prefers fewer vertices, then closer ones
constexpr double too_far = std::numeric_limits<double>::infinity();

bool is_turn(double turn) {
    return std::abs(turn) > 0.5;  // cross product of unit steps in a cell of area 1: -1, 0 or 1
}

constexpr std::size_t margin_steps = 2;  // steps on either side of a step that is too far from its trace

class Composer {
  public:
    Composer(const TraceSums& samples, const ChainPolyline& walls) : samples_(samples), walls_(walls) {}
    /// Appends a stretch of walls.
    void append(const ChainFitMode::Stretch& stretch, ChainPolyline& chain) const;

  private:
    [[nodiscard]] std::size_t count() const { return walls_.vertices.size(); }
    /// Indices of a closed chain wrap around.
    [[nodiscard]] FinePoint vertex(std::size_t k) const { return walls_.vertices[k % count()]; }
    [[nodiscard]] std::size_t step(std::size_t k) const {
        return walls_.steps[k % count()] + k / count() * samples_.steps();
    }
    [[nodiscard]] FinePoint at(std::size_t edge, std::size_t step) const;

    const TraceSums& samples_;
    const ChainPolyline& walls_;
};

/// Point of an edge that corresponds to a step.
FinePoint Composer::at(std::size_t edge, std::size_t step) const {
    const Vec2 from = samples_.from_fine(vertex(edge));
    const Vec2 to = samples_.from_fine(vertex(edge + 1));
    return samples_.to_fine(from + nearest_parameter(samples_.at(step), from, to) * (to - from));
}

void Composer::append(const ChainFitMode::Stretch& stretch, ChainPolyline& chain) const {
    const bool open = !samples_.closed();
    // The walls of a closed chain may begin later than its steps.
    std::size_t first = stretch.first;
    std::size_t last = stretch.last;
    const std::size_t lap = !open && first < step(0) ? samples_.steps() : 0;
    first += lap;
    last += lap;
    std::size_t k = 0;
    while (step(k + 1) <= first && (!open || k + 2 < count()))
        ++k;
    if (!open || stretch.first > 0)
        chain.add(at(k, first), stretch.first);
    for (++k; step(k) < last && (!open || k + 1 < count()); ++k) {
        if (step(k) <= first)
            continue;
        chain.add(vertex(k), step(k) - lap);
        const auto own = std::ranges::find(walls_.arcs, k % count(), &CircularArc::first);
        if (own != walls_.arcs.end() && step(k + own->edges) < last)
            chain.arcs.push_back({0, static_cast<std::uint32_t>(chain.vertices.size() - 1), own->edges});
    }
    if (!open || stretch.last < samples_.steps())
        chain.add(at(k - 1, last), stretch.last);
    else
        chain.add(walls_.vertices.back(), samples_.steps());
}

/// Composes a chain from stretches of walls and stretches that follow the trace more closely. A wall extends
/// to the point that corresponds to the first step of the next stretch.
/// @param walls the whole chain drawn with walls; unused if no step has that mode
/// @param ends of an open chain
ChainPolyline compose_chain(const TraceSums& samples, const ChainFitMode& mode,
                            const StepMidpoints& midpoints, const ChainPolyline& walls,
                            const std::optional<ChainEnds>& ends) {
    const std::vector<ChainFitMode::Stretch> stretches = mode.stretches();
    if (stretches.size() == 1 && stretches.front().mode == FitMode::regularized)
        return walls;
    ChainPolyline chain;
    if (ends)
        chain.add(ends->first, 0);
    const Composer composer(samples, walls);
    for (const ChainFitMode::Stretch& stretch : stretches) {
        const bool at_end = ends && stretch.last == samples.steps();
        if (stretch.mode == FitMode::regularized)
            composer.append(stretch, chain);
        else
            midpoints.append(stretch, at_end ? &ends->last : nullptr, chain);
    }
    // Both ends may have moved to the same point; comparing all chains detects that later.
    if (ends && chain.vertices.size() == 1) {
        chain.vertices.push_back(ends->last);
        chain.steps.push_back(samples.steps());
    }
    if (!ends && chain.vertices.size() > 1 && chain.vertices.front() == chain.vertices.back())
        chain.remove_last();
    chain.deviation = deviation(samples, chain, samples.closed());
    return chain;
}

/// Switches walls to a closer mode wherever they are farther from the trace than the limit.
/// @param mode of the chain as drawn @return true if anything has changed
bool tighten_far_steps(const TraceSums& samples, double limit, const ChainPolyline& drawn,
                       ChainFitMode& mode) {
    bool changed = false;
    // The ends of a chain are excluded, because they follow the chain they end on.
    const auto at_end = [&](std::size_t step) {
        return !samples.closed() && (step <= margin_steps || step + margin_steps >= samples.steps());
    };
    for_distances(samples, drawn, samples.closed(), [&](std::size_t step, double square) {
        if (square > limit * limit && !at_end(step))
            changed = mode.raise(step, step + 1, margin_steps, FitMode::midpoint) || changed;
    });
    return changed;
}

constexpr double rounding_error = 0.002;  // cells that rounding to the fine lattice may move a vertex
// Cells. Walls of tiers, which are many and short, stay closer to their traces than those of footprints
// because beyond half a cell every row of cells on the wrong side costs more than the saved vertices are
// worth. Rings of low steps may lie twice as far; walls that end on others would meet them at slanting
// angles.
constexpr double tier_tolerance = 1;
constexpr double tier_price = 0.5;           // relative to that of other walls
constexpr double max_price_share = 0.08;     // of the area of a ring, because no wall at all is the cheapest
constexpr double staircase_tolerance = 1.1;  // cells, within which a straight wall has its staircase
constexpr double max_side =
    2;  // cells; limits the longer side because that of sheared cells says nothing about their staircases
constexpr int max_tightenings = 4;  // limits the iterations; each one leaves less that is far from the trace

/// Returns the price of a wall between two tiers relative to that of one that is 2.5 m high. The error of a
/// stack is the area on the wrong side of the wall times the square of its height, so the low steps of a
/// slope may have few and straight walls, and high ones follow their trace.
double step_share(double step_m) {
    constexpr double usual_m = 2.5;
    return step_m > 0 ? std::clamp(std::pow(usual_m / step_m, 2), 0.5, 4.0) : 1;
}

WallParameters parameters_for(const Chain& chain, const WallOptions& options) {
    WallParameters parameters{.walls = options.walls,
                              .tolerance = options.tolerance,
                              .price = options.price,
                              .higher = chain.higher,
                              .inset = options.inset,
                              .side = std::min(max_side, options.shape.longer_side())};
    if (chain.rank > WallGraph::highest_low_rank) {
        const double share = step_share(chain.step * options.vertical_metres);
        const double reach = chain.closed ? std::clamp(share, 1.0, 2.0) : 1;
        parameters.tolerance = std::min(options.tolerance, reach * tier_tolerance);
        parameters.price *= tier_price * share;
    }
    return parameters;
}

/// Walls on the frame begin and end at turning points.
std::vector<std::size_t> turning_points_of(const ChainWalls& walls) {
    const TraceSums& samples = walls.samples();
    std::vector<std::size_t> points = turning_points(samples, staircase_tolerance);
    for (const WallSegment& wall : walls.on_frame())
        for (const std::size_t step : {wall.first, wall.last})
            points.push_back(samples.closed() ? step % samples.steps() : step);
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// Returns the stretches of a chain without those on the frame of the raster, because it was cut there.
/// @param points steps at which the chain may turn
std::vector<Stretch> stretches_between(const ChainWalls& walls, const std::vector<std::size_t>& points) {
    const TraceSums& samples = walls.samples();
    std::vector<Stretch> found;
    for (std::size_t i = 0; i + (samples.closed() ? 0 : 1) < points.size(); ++i) {
        const std::size_t first = points[i];
        const std::size_t last = i + 1 < points.size() ? points[i + 1] : samples.steps();
        if (is_on(walls.on_frame(), first, last))
            continue;
        const std::size_t cut = steps_at_corner(last - first);
        const Vec2 along = samples.sums(first + cut, last - cut).direction();
        found.push_back({length(samples.at(last) - samples.at(first)), std::atan2(along.y, along.x)});
    }
    return found;
}

}  // namespace

FitMode ChainFitMode::least(std::size_t first, std::size_t last) const {
    FitMode least = FitMode::beveled;
    for (std::size_t step = first; step < std::max(last, first + 1); ++step)
        if (closed_ || step < modes_.size())
            least = std::min(least, at(step));
    return least;
}

bool ChainFitMode::tighten(std::size_t first, std::size_t last, std::size_t margin) {
    const FitMode mode = least(first, last);
    return mode != FitMode::beveled && raise(first, last, margin, next(mode));
}

bool ChainFitMode::raise(std::size_t first, std::size_t last, std::size_t margin, FitMode mode) {
    const std::size_t n = modes_.size();
    std::size_t begin = 0;
    std::size_t end = n;
    if (!closed_) {
        begin = first - std::min(first, margin);
        end = std::min(last + margin, n);
    } else if (last - first + 2 * margin < n) {
        begin = first + n - margin;
        end = last + n + margin;
    }
    bool changed = false;
    for (std::size_t k = begin; k < end; ++k) {
        FitMode& own = modes_[k % n];
        changed = changed || own < mode;
        own = std::max(own, mode);
    }
    return changed;
}

bool ChainFitMode::beveled_around(std::size_t step) const {
    const std::size_t n = modes_.size();
    if (!closed_ && (step == 0 || step >= n))
        return at(step == 0 ? 0 : n - 1) == FitMode::beveled;
    return at(step) == FitMode::beveled && at(step + n - 1) == FitMode::beveled;
}

std::vector<ChainFitMode::Stretch> ChainFitMode::stretches() const {
    const std::size_t n = modes_.size();
    std::size_t begin = 0;
    if (closed_)
        while (begin < n && at(begin) == at(begin + n - 1))
            ++begin;
    if (begin == n)
        begin = 0;
    std::vector<Stretch> found;
    for (std::size_t k = begin; k < begin + n; ++k)
        if (found.empty() || found.back().mode != at(k))
            found.push_back({k, k + 1, at(k)});
        else
            ++found.back().last;
    std::vector<Stretch> result;
    for (std::size_t i = 0; i < found.size(); ++i) {
        Stretch stretch = found[i];
        if (stretch.mode == FitMode::regularized && found.size() > 1 &&
            stretch.last - stretch.first < min_wall_steps)
            stretch.mode = FitMode::midpoint;
        if (!result.empty() && result.back().mode == stretch.mode)
            result.back().last = stretch.last;
        else
            result.push_back(stretch);
    }
    return result;
}

StepMidpoints::StepMidpoints(const TraceSums& samples, const std::vector<std::uint32_t>& node_steps,
                             double tolerance)
    : samples_(samples),
      node_steps_(node_steps),
      tolerance_(tolerance),
      can_bevel_(can_bevel(samples.longest_step(), tolerance)) {}

/// Turn before a step; 0 at the ends of an open chain.
double StepMidpoints::turn(std::size_t step) const {
    const std::size_t n = samples_.steps();
    if (!samples_.closed() && (step == 0 || step >= n))
        return 0;
    return cross(unit(step + (samples_.closed() ? n : 0) - 1), unit(step));
}

/// Nodes of a closed chain may have steps beyond its first lap.
bool StepMidpoints::is_node(std::size_t step) const {
    const std::size_t n = samples_.steps();
    const auto contains = [&](std::size_t s) {
        return std::ranges::binary_search(node_steps_, static_cast<std::uint32_t>(s));
    };
    return samples_.closed() ? contains(step % n) || contains(step % n + n) : contains(step);
}

/// Returns true if a lattice corner may be a vertex: any corner except those of staircases, which alternate
/// between left and right turns.
bool StepMidpoints::is_vertex(std::size_t step, FitMode mode) const {
    if (mode == FitMode::beveled && is_node(step))
        return true;
    const double here = turn(step);
    if (!is_turn(here))
        return false;
    if (mode == FitMode::beveled && !can_bevel_)
        return true;
    const std::size_t n = samples_.steps();
    const std::size_t before = samples_.closed() ? step + n - 1 : step - 1;
    return !(turn(before % (samples_.closed() ? n : n + 1)) * here < -0.25 || turn(step + 1) * here < -0.25);
}

std::vector<StepMidpoints::Candidate> StepMidpoints::candidates(const ChainFitMode::Stretch& stretch) const {
    const bool whole = samples_.closed() && stretch.last - stretch.first == samples_.steps();
    std::vector<Candidate> points;
    points.reserve(stretch.last - stretch.first + 8);
    for (std::size_t k = stretch.first; k < stretch.last; ++k) {
        if ((k > stretch.first || whole) && is_vertex(k, stretch.mode))
            points.push_back({samples_.at(k), k, true, stretch.mode == FitMode::beveled && is_node(k)});
        points.push_back({samples_.midpoint(k), k, false, false});
    }
    return points;
}

/// Sum of squared distances between the corners of the trace and the edge joining two candidates.
double StepMidpoints::error(const Candidate& from, const Candidate& to, double limit) const {
    double sum = 0;
    samples_.for_corners(from.step + 1, to.step, [&](std::size_t, Vec2 corner) {
        const double square = square_distance(corner, from.place, to.place);
        sum = square > limit * limit ? too_far : sum + square;
        return sum < too_far;
    });
    return sum;
}

/// Selects the fewest candidates, and among these the closest, whose edges stay within a limit of the trace,
/// by dynamic programming. Keeps the first and the last one.
void StepMidpoints::select_vertices(std::vector<Candidate>& points, double limit) const {
    struct State {
        double cost = too_far;
        std::size_t from = 0;
    };
    std::vector<State> states(points.size());
    states[0].cost = 0;
    for (std::size_t to = 1; to < points.size(); ++to) {
        std::size_t failures = 0;
        for (std::size_t from = to; from-- > 0 && to - from <= max_chord_span && failures < max_failures;) {
            // Consecutive candidates may always be joined, because the trace between them is a corner being
            // cut off.
            const double squares = from + 1 == to ? 0 : error(points[from], points[to], limit);
            if (squares == too_far) {
                ++failures;
                continue;
            }
            const double cost = states[from].cost + vertex_cost + squares;
            if (cost < states[to].cost)
                states[to] = {cost, from};
        }
    }
    std::vector<Candidate> left;
    for (std::size_t at = points.size() - 1; at > 0; at = states[at].from)
        left.push_back(points[at]);
    left.push_back(points.front());
    points.assign(left.rbegin(), left.rend());
}

/// Removes candidates on the line between their neighbours.
void StepMidpoints::remove_collinear(std::vector<Candidate>& points) {
    std::vector<Candidate> left;
    left.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool inner = i > 0 && i + 1 < points.size() && !points[i].kept;
        if (inner && std::abs(cross(points[i].place - left.back().place,
                                    points[i + 1].place - points[i].place)) < 1e-9)
            continue;
        left.push_back(points[i]);
    }
    points = std::move(left);
}

void StepMidpoints::append(const ChainFitMode::Stretch& stretch, const FinePoint* end,
                           ChainPolyline& chain) const {
    std::vector<Candidate> points = candidates(stretch);
    const bool whole = samples_.closed() && stretch.last - stretch.first == samples_.steps();
    const bool from_start = !samples_.closed() && stretch.first == 0;
    if (from_start)
        points.insert(points.begin(), {samples_.from_fine(chain.vertices.back()), 0, true, true});
    if (end != nullptr)
        points.push_back({samples_.from_fine(*end), stretch.last, true, true});
    if (whole) {
        points.push_back(points.front());
        points.back().step += samples_.steps();
    }
    if (stretch.mode == FitMode::beveled)
        remove_collinear(points);
    else
        select_vertices(points, std::min(tolerance_, stretch.mode == FitMode::midpoint ? midpoint_tolerance
                                                                                       : tight_tolerance));
    if (whole)
        points.pop_back();
    for (std::size_t i = from_start ? 1 : 0; i < points.size(); ++i) {
        const bool last = end != nullptr && i + 1 == points.size();
        const FinePoint vertex = last ? *end : samples_.to_fine(points[i].place);
        chain.add(vertex, points[i].step);
    }
}

ChainFitter::ChainFitter(const Chain& chain, const WallOptions& options)
    : parameters_(parameters_for(chain, options)),
      limit_(parameters_.tolerance - rounding_error),
      walls_(chain, options),
      turning_points_(turning_points_of(walls_)),
      stretches_(stretches_between(walls_, turning_points_)),
      midpoints_(samples(), chain.node_steps, limit_) {
    if (chain.closed)
        parameters_.price =
            std::min(parameters_.price, max_price_share * std::abs(twice_area(samples())) / 2);
}

bool ChainFitter::plan(double price, WallDirections& directions, bool turn_frames, const StopToken& stop) {
    WallParameters parameters = parameters_;
    parameters.price *= price;
    if (!walls_.plan(turning_points_, parameters, directions, turn_frames, stop))
        return false;
    planned_.reset();
    return true;
}

const ChainPolyline& ChainFitter::draw_planned(const std::optional<ChainEnds>& ends) {
    if (!planned_ || ends != ends_of_planned_) {
        planned_ = draw_walls(samples(), parameters_, walls_.segments(), ends);
        ends_of_planned_ = ends;
    }
    return *planned_;
}

bool ChainFitter::walls_are_near(const std::optional<ChainEnds>& ends) {
    return draw_planned(ends).deviation <= limit_;
}

/// True if this is a line, or a ring with the orientation of its trace.
bool ChainFitter::is_sound(const ChainPolyline& drawn) const {
    if (!samples().closed())
        return drawn.vertices.size() >= 2;
    return drawn.vertices.size() >= 3 && twice_area(drawn.vertices, samples()) * twice_area(samples()) > 0;
}

ChainPolyline ChainFitter::draw(ChainFitMode& mode, const std::optional<ChainEnds>& ends) {
    ChainPolyline planned;
    if (mode.has_walls()) {
        draw_planned(ends);
        planned =
            *std::exchange(planned_, {});  // released because few chains are drawn twice and many are pending
    }
    const auto compose = [&] { return compose_chain(samples(), mode, midpoints_, planned, ends); };
    ChainPolyline drawn = compose();
    for (int i = 0; i < max_tightenings && drawn.deviation > limit_; ++i) {
        if (!tighten_far_steps(samples(), limit_, drawn, mode))
            break;
        drawn = compose();
    }
    while (!is_sound(drawn) && mode.tighten(0, samples().steps(), 0))
        drawn = compose();
    return drawn;
}

}  // namespace d2b::outline
