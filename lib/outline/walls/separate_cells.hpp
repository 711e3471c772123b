#pragma once

#include <vector>

#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Moves each straight wall, without turning it, to where the cells beside its stretch of the trace lie on
/// their own sides of it with their middles, as far as one line can have that, and no farther than that
/// needs: a line that is nearest to a staircase leaves some on the wrong side, each of which is wrong by the
/// height of the wall.
/// @param higher the side of the trace on which its building or tier lies: 1 the left, -1 the right, 0 both
/// @param limit cells between a wall and its trace
void separate_cells(const WallSamples& samples, int higher, double limit, std::vector<WallPiece>& pieces);

}  // namespace d2b
