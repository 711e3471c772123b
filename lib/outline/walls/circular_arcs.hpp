#pragma once

#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Replaces runs of walls that turn the same way by circular arcs if these are the cheaper description, and
/// all walls of a closed chain by a circle. Walls::automatic only. @throws Cancelled
void find_circular_arcs(const WallSamples& samples, const WallStyle& style, std::vector<WallPiece>& pieces,
                        const StopRequest& stop);

}  // namespace d2b
