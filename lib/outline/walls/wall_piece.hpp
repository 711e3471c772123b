#pragma once

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

struct WallStyle {
    static constexpr double variance = 0.3;  ///< of the middle of a step about its wall, square cells

    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    double price = 1;      ///< of a wall: less gives more walls that lie closer
};

}  // namespace d2b
