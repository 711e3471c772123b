#pragma once

#include "dem2buildings/options.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// Parameters of wall fitting.
struct WallOptions {
    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    CellShape shape;
    double inset = 0;  ///< cells by which walls are moved inward
};

}  // namespace d2b
