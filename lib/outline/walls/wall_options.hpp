#pragma once

#include "dem2buildings/options.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// How walls are fitted.
struct WallOptions {
    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    CellShape shape;
};

}  // namespace d2b
