#pragma once

#include <vector>

#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Moves a wall to the left of the direction of its chain. @param cells negative: to the right
void shift_wall(WallPiece& piece, const WallSamples& samples, double cells);

/// Moves walls towards higher ground, by the largest number of quarters of `cells` that keeps them within a
/// limit of their trace. Arcs move by the full distance, because their distance is checked when they are
/// drawn.
/// @param higher side of the trace on which its building or tier lies: 1 left, -1 right, 0 both (such walls
/// stay)
void move_inward(const WallSamples& samples, int higher, double cells, double limit,
                 std::vector<WallPiece>& pieces);

}  // namespace d2b
