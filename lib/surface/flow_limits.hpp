#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/lattice.hpp"

namespace d2b::surface {

/// Converts steps of the fine lattice to lengths on the ground.
struct FlowMetric {
    double col_x = 1;  ///< metres per step along the columns
    double col_y = 0;
    double row_x = 0;
    double row_y = -1;

    [[nodiscard]] double x(FinePoint from, FinePoint to) const {
        return static_cast<double>(to.col - from.col) * col_x +
               static_cast<double>(to.row - from.row) * row_x;
    }
    [[nodiscard]] double y(FinePoint from, FinePoint to) const {
        return static_cast<double>(to.col - from.col) * col_y +
               static_cast<double>(to.row - from.row) * row_y;
    }
    [[nodiscard]] double distance(FinePoint a, FinePoint b) const { return length(x(a, b), y(a, b)); }
    /// Distance from a point to the segment between two distinct points, m.
    [[nodiscard]] double distance_to(FinePoint point, FinePoint a, FinePoint b) const {
        const double along =
            (x(a, point) * x(a, b) + y(a, point) * y(a, b)) / (x(a, b) * x(a, b) + y(a, b) * y(a, b));
        const double share = std::clamp(along, 0.0, 1.0);
        return length(x(a, point) - share * x(a, b), y(a, point) - share * y(a, b));
    }
    /// Number of steps that reaches everything within a distance in m. It is larger than distance by step if
    /// cells are not rectangles, because these extend farther along the lattice than on the ground.
    [[nodiscard]] std::int64_t steps_around(double metres) const {
        return static_cast<std::int64_t>(
            std::ceil(metres * std::max(std::hypot(col_x, col_y), std::hypot(row_x, row_y)) / area()));
    }
    /// Square metres per square step.
    [[nodiscard]] double area() const { return std::abs(col_x * row_y - col_y * row_x); }

  private:
    /// Not std::hypot(), because it is far slower and its guard against overflow is of no use here.
    [[nodiscard]] static double length(double x, double y) { return std::sqrt(x * x + y * y); }
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
