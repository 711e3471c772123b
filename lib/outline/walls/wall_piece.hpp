#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "dem2buildings/options.hpp"
#include "outline/walls/circle.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// A range of steps of a traced chain that is drawn as one straight wall or circular arc.
struct WallPiece {
    static constexpr int free = 4;  ///< family of walls with an arbitrary direction

    std::size_t first = 0;  ///< step
    std::size_t last = 0;   ///< one past the last step
    int family = free;      ///< 0 .. 3: the dominant direction turned by 0, 90, 45, 135 degrees
    Line line;
    std::optional<Circle> circle;  ///< set if the segment is an arc
    double cost = 0;
};

/// Margin in cells subtracted from the tolerance, because intersections of walls are rounded to the fine
/// lattice.
constexpr double wall_clearance = 0.05;

struct WallStyle {
    static constexpr double variance =
        0.3;  ///< variance of step midpoints about their wall, for square cells

    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    double price = 1;      ///< cost of a wall: a lower price gives more walls that lie closer
    double inset = 0;      ///< cells by which walls are moved towards higher ground
    double side = 1;       ///< longer side of a cell

    /// Largest distance in cells between a straight wall and the corners of its staircase: half a diagonal
    /// plus the error of the position of the wall.
    [[nodiscard]] double straight_reach() const { return std::min(0.77 * side, 0.72 * tolerance); }
    /// Cost of the squared distances of n step midpoints in excess of those that the staircase of a straight
    /// wall has anyway: up to a twelfth of a squared side per step, here slightly more.
    [[nodiscard]] double misfit(double squares, double n) const {
        return std::max(0.0, squares - 0.09 * side * side * n) / variance;
    }
};

}  // namespace d2b
