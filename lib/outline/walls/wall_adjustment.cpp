#include "outline/walls/wall_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace d2b::outline
