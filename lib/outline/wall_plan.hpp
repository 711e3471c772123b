#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/options.hpp"
#include "core/stop_request.hpp"
#include "outline/circle.hpp"
#include "outline/wall_samples.hpp"

namespace d2b {

/// A stretch of a traced chain that is drawn as one wall.
struct WallPiece {
    static constexpr int free = 4;  ///< the family of walls of any direction

    std::size_t first = 0;  ///< step
    std::size_t last = 0;   ///< step one past its end
    int family = free;      ///< 0 .. 3: the dominant direction turned by 0, 90, 45, 135 degrees
    Line line;
    std::optional<Circle> circle;  ///< where it is an arc and not a wall
    double cost = 0;
};

struct WallStyle {
    static constexpr double variance = 0.3;  ///< of the middle of a step about its wall, square cells

    Walls walls = Walls::automatic;
    double tolerance = 1.5;  ///< cells
    double price = 1;        ///< of a wall: less gives more walls that lie closer
};

/// The direction that the long stretches of a chain have in common, modulo 90 degrees, in radians.
/// @param points at which it may turn
[[nodiscard]] double dominant_direction(const WallSamples& samples, const std::vector<std::size_t>& points);

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

/// Steps at which a chain may turn: the vertices of its Douglas-Peucker line at 0.8 cells. Starts with 0; an
/// open chain ends with its last step.
[[nodiscard]] std::vector<std::size_t> turning_points(const WallSamples& samples);

}  // namespace d2b
