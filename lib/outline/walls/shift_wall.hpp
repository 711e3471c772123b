#pragma once

#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Moves a wall to the left of the way that its chain runs. @param cells negative: to the right
void shift_wall(WallPiece& piece, const WallSamples& samples, double cells);

}  // namespace d2b
