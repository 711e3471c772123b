#include "outline/walls/wall_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "outline/walls/wall_path.hpp"

namespace d2b::outline {

void fit_offset(const TraceSums& samples, WallSegment& wall) {
    constexpr double near = 0.9;  // cells
    constexpr double min_weight = 0.35;
    double sum = 0;
    double weights = 0;
    for (std::size_t step = wall.first; step < wall.last; ++step) {
        const Vec2 along = samples.at(step + 1) - samples.at(step);
        const double weight = dot(along, wall.line.along);
        const double offset = wall.line.offset(samples.midpoint(step));
        if (weight <= 0 || std::abs(offset) > near)
            continue;
        sum += weight * offset;
        weights += weight;
    }
    if (weights > min_weight)
        wall.line.through = wall.line.through + sum / weights * Vec2{-wall.line.along.y, wall.line.along.x};
}

double adjust_frames(const TraceSums& samples, const std::vector<WallSegment>& walls,
                     WallDirections& directions) {
    constexpr double near = 1;        // cells
    constexpr double min_length = 5;  // cells
    constexpr double most = 4 * degree;
    const std::size_t n = directions.frames.size() + directions.single.size();
    std::vector<double> turns(n + 1);
    std::vector<double> weights(n + 1);
    for (const WallSegment& wall : walls) {
        if (!wall.is_wall() || wall.family > static_cast<int>(n))
            continue;
        double w = 0;
        double x = 0;
        double y = 0;
        double xx = 0;
        double xy = 0;
        const std::size_t cut = steps_at_corner(wall.last - wall.first);
        for (std::size_t step = wall.first + cut; step < wall.last - cut; ++step) {
            const Vec2 along = samples.at(step + 1) - samples.at(step);
            const Vec2 middle = samples.midpoint(step);
            const double weight = std::abs(dot(along, wall.line.along));
            const double offset = wall.line.offset(middle);
            if (std::abs(offset) > near)
                continue;
            const double at = dot(middle, wall.line.along);
            w += weight;
            x += weight * at;
            y += weight * offset;
            xx += weight * at * at;
            xy += weight * at * offset;
        }
        if (w < min_length)
            continue;
        const double variance = xx - x * x / w;
        // The walls at 45 degrees follow the main direction.
        const std::size_t slot =
            static_cast<std::size_t>(wall.family) == n ? 0 : static_cast<std::size_t>(wall.family);
        turns[slot] += xy - x * y / w;
        weights[slot] += variance;
    }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(weights[i] > 0))
            continue;
        const double turn = std::clamp(turns[i] / weights[i], -most, most);
        double& direction = i < directions.frames.size() ? directions.frames[i]
                                                         : directions.single[i - directions.frames.size()];
        direction += turn;
        largest = std::max(largest, std::abs(turn));
    }
    return largest;
}

void turn_walls(const TraceSums& samples, const WallDirections& from, const WallDirections& to,
                std::vector<WallSegment>& walls) {
    const std::size_t frames = from.frames.size();
    for (WallSegment& wall : walls) {
        if (!wall.is_wall())
            continue;
        const auto family = static_cast<std::size_t>(wall.family);
        const bool single = family >= frames && family < frames + from.single.size();
        const std::size_t frame = family < frames ? family : 0;
        const double turn = single ? to.single[family - frames] - from.single[family - frames]
                                   : to.frames[frame] - from.frames[frame];
        wall.line.through = wall.line.project(samples.sums(wall.first, wall.last).mean);
        const Vec2 along = wall.line.along;
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        wall.line.along = {c * along.x - s * along.y, s * along.x + c * along.y};
        fit_offset(samples, wall);
    }
}

namespace {

constexpr double max_turn = 3 * degree;  // from the walls that are joined; corners still look right
constexpr double max_rms = 0.6;          // cells between a wall and its steps, because bays are not jogs
constexpr std::size_t max_jogs = 8;

/// A wall instead of several.
struct JoinedWall {
    std::size_t last;  // index of the last wall that it replaces
    double gain;
    WallSegment wall;
};

class WallJoiner {
  public:
    WallJoiner(const TraceSums& samples, const WallParameters& parameters, std::vector<WallSegment>& walls)
        : samples_(samples),
          parameters_(parameters),
          walls_(walls),
          higher_(samples.mirrored() ? -parameters.higher : parameters.higher) {}

    /// Joins a wall with those after it, if that costs less.
    void join_from(std::size_t first);

  private:
    /// Indices of closed chains wrap around.
    [[nodiscard]] const WallSegment& at(std::size_t i) const { return walls_[i % walls_.size()]; }
    [[nodiscard]] bool has(std::size_t i) const { return samples_.closed() || i < walls_.size(); }
    [[nodiscard]] bool is_jog(std::size_t i) const;
    [[nodiscard]] double cost(const WallSegment& wall) const;
    [[nodiscard]] bool fits(const WallSegment& wall, std::size_t first, std::size_t last) const;
    [[nodiscard]] WallSegment join(std::size_t first, std::size_t last) const;
    void replace(std::size_t first, const JoinedWall& joined);

    const TraceSums& samples_;
    const WallParameters& parameters_;
    std::vector<WallSegment>& walls_;
    int higher_;  // sign of offsets on lower ground
};

/// True if a wall leads from one wall to another with exactly its direction; joined walls have their own.
bool WallJoiner::is_jog(std::size_t i) const {
    constexpr double parallel = 1 - 1e-9;
    return at(i - 1).is_wall() && at(i).is_wall() && at(i + 1).is_wall() &&
           dot(at(i - 1).line.along, at(i + 1).line.along) > parallel;
}

double WallJoiner::cost(const WallSegment& wall) const {
    double sum = 0;
    for (std::size_t step = wall.first; step < wall.last; ++step)
        sum += length(samples_.at(step + 1) - samples_.at(step)) *
               distance_cost(wall.line.offset(samples_.midpoint(step)), higher_);
    return sum;
}

/// Returns the line nearest to the steps of some walls.
WallSegment WallJoiner::join(std::size_t first, std::size_t last) const {
    WallSegment joined = at(first);
    joined.last = at(last).last + (last < walls_.size() ? 0 : samples_.steps());
    // Sums begin in the first lap.
    if (joined.last >= 2 * samples_.steps()) {
        joined.first -= samples_.steps();
        joined.last -= samples_.steps();
    }
    const TraceSums::Sums sums = samples_.sums(joined.first, joined.last);
    const Vec2 along = sums.direction();
    joined.line = {sums.mean, dot(along, joined.line.along) < 0 ? -1 * along : along};
    return joined;
}

/// True if a wall may replace others: it lies near its steps, and makes corners with its neighbours.
bool WallJoiner::fits(const WallSegment& wall, std::size_t first, std::size_t last) const {
    const TraceSums::Sums sums = samples_.sums(wall.first, wall.last);
    const auto meets = [&](const WallSegment& other) {
        return !other.is_wall() || std::abs(cross(other.line.along, wall.line.along)) >= std::sin(min_turn);
    };
    return dot(wall.line.along, at(first).line.along) >= std::cos(max_turn) &&
           sums.least_squares() <= max_rms * max_rms * sums.n &&
           samples_.near(wall.first, wall.last, wall.line, parameters_.tolerance - wall_clearance) &&
           (!(samples_.closed() || first > 0) || meets(at(first + walls_.size() - 1))) &&
           (!has(last + 1) || meets(at(last + 1)));
}

void WallJoiner::replace(std::size_t first, const JoinedWall& joined) {
    // Those after the last wall of a closed chain are its first ones.
    const std::size_t end = joined.last + 1;
    const std::size_t wrapped = end - std::min(end, walls_.size());
    const auto begin = walls_.begin();
    walls_.erase(begin + static_cast<std::ptrdiff_t>(first),
                 begin + static_cast<std::ptrdiff_t>(end - wrapped));
    walls_.erase(begin, begin + static_cast<std::ptrdiff_t>(wrapped));
    walls_.insert(std::ranges::upper_bound(walls_, joined.wall.first, {}, &WallSegment::first), joined.wall);
}

void WallJoiner::join_from(std::size_t first) {
    const std::size_t n = walls_.size();
    std::optional<JoinedWall> best;
    double costs = cost(at(first));
    // A ring keeps three walls.
    for (std::size_t last = first + 2; last <= first + 2 * max_jogs && has(last) && last + 2 < first + n;
         last += 2) {
        if (!is_jog(last - 1))
            break;
        costs += cost(at(last - 1)) + cost(at(last));
        const WallSegment wall = join(first, last);
        const double gain = costs + parameters_.price * static_cast<double>(last - first) - cost(wall);
        if (gain > (best ? best->gain : 0) && fits(wall, first, last))
            best = {last, gain, wall};
    }
    if (best)
        replace(first, *best);
}

}  // namespace

void join_parallel_walls(const TraceSums& samples, const WallParameters& parameters,
                         std::vector<WallSegment>& walls) {
    WallJoiner joiner(samples, parameters, walls);
    for (std::size_t i = 0; i < walls.size(); ++i)
        joiner.join_from(i);
}

}  // namespace d2b::outline
