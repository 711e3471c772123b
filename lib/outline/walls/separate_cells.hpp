#pragma once

#include <vector>

#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Shifts each straight wall in parallel so that the cells along its trace have their centers on the correct
/// sides, as far as possible for one line, and not farther than necessary. This is needed because the line
/// nearest to a staircase leaves some cells on the wrong side, and the error of each is the height of the
/// wall.
/// @param higher side of the trace on which its building or tier lies: 1 left, -1 right, 0 both
/// @param limit largest distance in cells between a wall and its trace
void separate_cells(const WallSamples& samples, int higher, double limit, std::vector<WallPiece>& pieces);

}  // namespace d2b
