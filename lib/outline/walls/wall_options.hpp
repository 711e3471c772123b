#pragma once

#include "dem2buildings/options.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// How walls are fitted.
struct WallOptions {
    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    CellShape shape;
    double inset = 0;  ///< cells: walls move inward by it
};

}  // namespace d2b
