#include "ground.hpp"

#include <algorithm>
#include <cmath>

#include "random.hpp"

namespace d2b::sample {

namespace {

/// Rises from 0 at t <= 0 to 1 at t >= 1, level at both ends.
double smooth_step(double t) {
    const double u = std::clamp(t, 0.0, 1.0);
    return u * u * u * (u * (u * 6 - 15) + 10);
}

double distance_outside(const Rect& rect, const Position& p) {
    const double dx = std::max({rect.x0 - p.x, 0.0, p.x - rect.x1});
    const double dy = std::max({rect.y0 - p.y, 0.0, p.y - rect.y1});
    return distance({0, 0}, {dx, dy});
}

double depth_at(const Creek& creek, const Position& p) {
    double nearest = creek.half_width;
    for (std::size_t i = 1; i < creek.line.size(); ++i)
        nearest = std::min(nearest, distance_to_segment(creek.line[i - 1], creek.line[i], p));
    return creek.depth * (1 - smooth_step(nearest / creek.half_width));
}

/// Between 0 and 1: furrows 3 m apart along y, where a field is ploughed.
double furrow_depth(const Position& p) {
    const double field = std::floor(p.x / 180) + std::floor(p.y / 240);
    if (field / 2 != std::floor(field / 2))
        return 0;
    const double u = p.x / 3 - std::floor(p.x / 3);
    return smooth_step(1 - std::abs(2 * u - 1));
}

}  // namespace

double value_noise(std::uint64_t seed, double wavelength, const Position& p) {
    const double x = std::floor(p.x / wavelength);
    const double y = std::floor(p.y / wavelength);
    const auto i = static_cast<std::int64_t>(x);
    const auto j = static_cast<std::int64_t>(y);
    const double u = smooth_step(p.x / wavelength - x);
    const double v = smooth_step(p.y / wavelength - y);
    const double south = uniform_at(seed, i, j) * (1 - u) + uniform_at(seed, i + 1, j) * u;
    const double north = uniform_at(seed, i, j + 1) * (1 - u) + uniform_at(seed, i + 1, j + 1) * u;
    return south * (1 - v) + north * v;
}

double Ground::at(const Position& p) const {
    double z = base + slope_x * p.x + slope_y * p.y;
    if (relief > 0) {
        z += relief * (0.76 * value_noise(seed, 620, p) + 0.2 * value_noise(seed + 1, 230, p) +
                       0.04 * value_noise(seed + 2, 70, p));
    }
    if (furrow > 0)
        z -= furrow_depth(p) * furrow;
    for (const Creek& creek : creeks)
        z -= depth_at(creek, p);
    for (const Terrace& terrace : terraces) {
        const double outside = distance_outside(terrace.rect, terrace.frame.to_local(p));
        if (outside < terrace.bank)
            z += (terrace.elevation - z) * (1 - smooth_step(outside / terrace.bank));
    }
    return z;
}

void Ground::level(const Frame& frame, const Rect& rect) {
    terraces.push_back({frame, rect, at(frame.to_scene(rect.centre()))});
}

}  // namespace d2b::sample
