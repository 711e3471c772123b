#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Divides a chain into walls by dynamic programming over its turning points. Minimizes the sum of a price
/// per wall and of squared distances, subject to every wall staying within the tolerance of its trace. Walls
/// in the dominant direction and at 90 degrees to it are cheapest; consecutive walls never share a direction.
/// O(steps), because a wall spans at most 64 points.
/// @param points steps at which the chain may turn
/// @param direction dominant direction in radians; adjusted to the walls that follow it
/// @return nullopt if there is no such division @throws Cancelled
[[nodiscard]] std::optional<std::vector<WallPiece>> plan_walls(const WallSamples& samples,
                                                               std::vector<std::size_t> points,
                                                               const WallStyle& style, double& direction,
                                                               const StopRequest& stop);

}  // namespace d2b
