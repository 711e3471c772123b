#pragma once

#include <algorithm>
#include <cmath>

namespace d2b {

/// A 2-D vector, point or direction.
struct Vec2 {
    double x = 0;
    double y = 0;

    friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator*(double f, Vec2 a) { return {f * a.x, f * a.y}; }
    friend bool operator==(const Vec2&, const Vec2&) = default;
};
[[nodiscard]] inline double dot(Vec2 a, Vec2 b) {
    return a.x * b.x + a.y * b.y;
}
[[nodiscard]] inline double cross(Vec2 a, Vec2 b) {
    return a.x * b.y - a.y * b.x;
}
[[nodiscard]] inline double length(Vec2 a) {
    return std::sqrt(dot(a, a));
}
/// Parameter of the point of segment ab nearest to p: 0 at a, 1 at b.
[[nodiscard]] inline double nearest_parameter(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double square = dot(along, along);
    return square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
}
/// Squared distance from a point to a segment.
[[nodiscard]] inline double square_distance(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 offset = p - a - nearest_parameter(p, a, b) * (b - a);
    return dot(offset, offset);
}

}  // namespace d2b
