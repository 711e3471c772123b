#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/lattice.hpp"
#include "geometry/vec2.hpp"

namespace d2b::surface {

/// Converts steps of the fine lattice to lengths on the ground.
struct FlowMetric {
    Vec2 col{1, 0};  ///< metres per step along the columns
    Vec2 row{0, -1};

    /// Way from one point to another, in metres.
    [[nodiscard]] Vec2 way(FinePoint from, FinePoint to) const {
        return static_cast<double>(to.col - from.col) * col + static_cast<double>(to.row - from.row) * row;
    }
    [[nodiscard]] double distance(FinePoint a, FinePoint b) const { return length(way(a, b)); }
    /// Distance from a point to the segment between two distinct points, m.
    [[nodiscard]] double distance_to(FinePoint point, FinePoint a, FinePoint b) const {
        return std::sqrt(square_distance(way(a, point), {}, way(a, b)));
    }
    /// Share of the way from a to b at which it is nearest to a point.
    [[nodiscard]] double nearest_share(FinePoint point, FinePoint a, FinePoint b) const {
        return nearest_parameter(way(a, point), {}, way(a, b));
    }
    [[nodiscard]] double shorter_step() const {
        return std::min(std::hypot(col.x, col.y), std::hypot(row.x, row.y));
    }
    [[nodiscard]] double longer_step() const {
        return std::max(std::hypot(col.x, col.y), std::hypot(row.x, row.y));
    }
    /// Number of steps that reaches everything within a distance in m. It is larger than distance by step if
    /// cells are not rectangles, because these extend farther along the lattice than on the ground.
    [[nodiscard]] std::int64_t steps_around(double metres) const {
        return static_cast<std::int64_t>(std::ceil(metres * longer_step() / area()));
    }
    /// Square metres per square step.
    [[nodiscard]] double area() const { return std::abs(cross(col, row)); }
};

/// Limits of the geometry that a flow solver accepts.
struct FlowLimits {
    /// Degrees; the smallest input angle that quality triangulations can refine (Shewchuk 1997).
    static constexpr double least_angle = 20.7;
    static constexpr double most_share = 0.01;

    double gap = 0;              ///< m: narrower gaps are closed; 0: none
    double wall = 0;             ///< m: shorter walls are merged, narrower parts widened; 0: none
    double angle = least_angle;  ///< degrees in plan
    double share = most_share;   ///< share of a block's area that all changes together may take
    FlowMetric metric;
};

}  // namespace d2b::surface
