#pragma once

#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Puts circular arcs in the place of runs of walls that turn one way, where that is the cheaper description,
/// and a circle in the place of all walls of a closed chain. Walls::automatic alone. @throws Cancelled
void find_circular_arcs(const WallSamples& samples, const WallStyle& style, std::vector<WallPiece>& pieces,
                        const StopRequest& stop);

}  // namespace d2b
