#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "dem2buildings/options.hpp"
#include "outline/walls/circle.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// A stretch of a traced chain that is drawn as one wall.
struct WallPiece {
    static constexpr int free = 4;  ///< the family of walls of any direction

    std::size_t first = 0;  ///< step
    std::size_t last = 0;   ///< step one past its end
    int family = free;      ///< 0 .. 3: the dominant direction turned by 0, 90, 45, 135 degrees
    Line line;
    std::optional<Circle> circle;  ///< where it is an arc and not a wall
    double cost = 0;
};

/// Cells that walls stay farther within the tolerance than asked: where two meet is put on the fine lattice.
constexpr double wall_clearance = 0.05;

struct WallStyle {
    static constexpr double variance = 0.3;  ///< of the middle of a step about its wall, square cells

    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    double price = 1;      ///< of a wall: less gives more walls that lie closer
    double inset = 0;      ///< cells: walls move towards what is higher by it
    double side = 1;       ///< of a cell, the longer one

    /// Cells: how far from a straight wall the corners of its staircase may lie, which is half a diagonal and
    /// what its place is off.
    [[nodiscard]] double straight_reach() const { return std::min(0.77 * side, 0.72 * tolerance); }
    /// What squared distances of the middles of n steps cost beyond those that the staircase of a straight
    /// wall leaves: up to a twelfth of a side squared a step, here a little more.
    [[nodiscard]] double misfit(double squares, double n) const {
        return std::max(0.0, squares - 0.09 * side * side * n) / variance;
    }
};

}  // namespace d2b
