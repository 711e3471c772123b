#pragma once

#include <vector>

#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Moves a wall to the left of the way that its chain runs. @param cells negative: to the right
void shift_wall(WallPiece& piece, const WallSamples& samples, double cells);

/// Moves walls towards what is higher, by as many quarters of a move as leave them within a limit of their
/// trace. Arcs of circles move by all of it: where they lie too far away is seen when they are drawn.
/// @param higher the side of the trace on which its building or tier lies: 1 the left, -1 the right, 0 both,
/// and such walls stay
void move_inward(const WallSamples& samples, int higher, double cells, double limit,
                 std::vector<WallPiece>& pieces);

}  // namespace d2b
