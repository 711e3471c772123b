#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Divides a chain into walls by dynamic programming over the points where it may turn: the least sum of a
/// price a wall and of squared distances, where all of a stretch lies within the tolerance of its wall. Walls
/// in the dominant direction are cheapest, those at 90 degrees to it as well; neighbours never have the same
/// one. O(steps), but for a window of 64 points over which a wall may reach.
/// @param points at which the chain may turn
/// @param direction the dominant one, radians; adjusted to the walls that follow it
/// @return nothing where no such division exists @throws Cancelled
[[nodiscard]] std::optional<std::vector<WallPiece>> plan_walls(const WallSamples& samples,
                                                               std::vector<std::size_t> points,
                                                               const WallStyle& style, double& direction,
                                                               const StopRequest& stop);

}  // namespace d2b
