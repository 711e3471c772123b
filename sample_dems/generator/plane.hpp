#pragma once

#include <span>

#include "dem2buildings/sinks.hpp"

namespace d2b::sample {

/// Scenes are made in metres, x to the east, y to the north, from the raster's lower left corner.

/// An upright rectangle; half open, so that neighbours share no point.
struct Rect {
    double x0 = 0;
    double y0 = 0;
    double x1 = 0;
    double y1 = 0;

    [[nodiscard]] double width() const { return x1 - x0; }
    [[nodiscard]] double depth() const { return y1 - y0; }
    [[nodiscard]] Position centre() const { return {(x0 + x1) / 2, (y0 + y1) / 2}; }
    [[nodiscard]] bool contains(const Position& p) const {
        return p.x >= x0 && p.x < x1 && p.y >= y0 && p.y < y1;
    }
    [[nodiscard]] Rect grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
};

/// A direction as a unit vector: (cosine, sine) of the angle from the x axis, counter-clockwise.
struct Direction {
    double cosine = 1;
    double sine = 0;

    /// @param t the tangent of half the angle. Needs neither sine nor cosine of the C library.
    static Direction from_half_tangent(double t);
};

/// A rotated and shifted coordinate system.
struct Frame {
    Position origin;
    Direction x_axis;

    [[nodiscard]] Position to_scene(const Position& local) const;
    [[nodiscard]] Position to_local(const Position& scene) const;
    [[nodiscard]] WorldPolygon to_scene(const WorldPolygon& local) const;
    /// This frame with its origin at one of its places.
    [[nodiscard]] Frame moved(const Position& local) const { return {to_scene(local), x_axis}; }
};

[[nodiscard]] double distance(const Position& a, const Position& b);
[[nodiscard]] Position middle(const Position& a, const Position& b);
/// How far p lies left of the line from a to b; negative on its right.
[[nodiscard]] double left_of(const Position& a, const Position& b, const Position& p);
/// Distance from p to the segment a, b.
[[nodiscard]] double distance_to_segment(const Position& a, const Position& b, const Position& p);

/// Even-odd rule; of two polygons that share a wall exactly one contains a point on it.
[[nodiscard]] bool contains(const WorldPolygon& polygon, const Position& p);
[[nodiscard]] Rect bounds(std::span<const Position> positions);

}  // namespace d2b::sample
