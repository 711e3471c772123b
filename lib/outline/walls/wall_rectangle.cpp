#include "outline/walls/wall_rectangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace d2b::outline {

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

}  // namespace d2b::outline
