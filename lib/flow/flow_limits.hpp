#pragma once

#include <cmath>

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
    double share = most_share;   ///< of a block's area that one change may take
    FlowMetric metric;
};

}  // namespace d2b
