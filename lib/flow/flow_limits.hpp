#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/lattice.hpp"

namespace d2b {

/// Lengths on the ground of steps of the fine lattice.
struct FlowMetric {
    double col_x = 1;  ///< metres that a step along the columns goes
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
    [[nodiscard]] double distance(FinePoint a, FinePoint b) const { return std::hypot(x(a, b), y(a, b)); }
    /// From a point to a straight line between two others, which are distinct.
    [[nodiscard]] double distance_to(FinePoint point, FinePoint a, FinePoint b) const {
        const double along =
            (x(a, point) * x(a, b) + y(a, point) * y(a, b)) / (x(a, b) * x(a, b) + y(a, b) * y(a, b));
        const double share = std::clamp(along, 0.0, 1.0);
        return std::hypot(x(a, point) - share * x(a, b), y(a, point) - share * y(a, b));
    }
    /// Steps in which all lies that is so near, m. Cells that are no rectangles reach farther along the
    /// lattice than on the ground.
    [[nodiscard]] std::int64_t steps_around(double metres) const {
        return static_cast<std::int64_t>(
            std::ceil(metres * std::max(std::hypot(col_x, col_y), std::hypot(row_x, row_y)) / area()));
    }
    /// Square metres in a square step.
    [[nodiscard]] double area() const { return std::abs(col_x * row_y - col_y * row_x); }
};

/// What a flow solver can take.
struct FlowLimits {
    /// Degrees; what triangulations with good angles can refine (Shewchuk 1997).
    static constexpr double least_angle = 20.7;
    static constexpr double most_share = 0.01;

    double gap = 0;              ///< m: what is nearer is closed; 0: nothing
    double wall = 0;             ///< m: shorter walls are merged; 0: none
    double angle = least_angle;  ///< degrees in plan
    double share = most_share;   ///< of a block's area that changes may take, all together
    FlowMetric metric;
};

}  // namespace d2b
