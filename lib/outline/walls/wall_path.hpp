#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/stop_token.hpp"
#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_directions.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Cost of a step per cell of its length by the distance of its midpoint from its line, in cells. Distances
/// beyond three quarters of a cell count as areas; those of lower ground more, because a cell of it in a
/// building is wrong by the height of the wall.
/// @param offset of the midpoint to the left of the line @param higher sign of offsets on lower ground; 0 if
/// both sides are alike
[[nodiscard]] double distance_cost(double offset, int higher);

/// Divides a chain into walls by a shortest path: each step of the trace gets a line, which is one of a few
/// directions and an offset. The least sum wins of the distances of the steps from their lines, a price per
/// wall and a price per corner that is not a right angle. Distances below three quarters of a cell count by
/// their square, because otherwise the staircase of a slanted wall would be paid for.
///
/// O(steps * directions * offsets); a few megabytes for any number of steps. Do not use it for round walls,
/// which are found before.
/// @param first, last steps; all around a closed chain if last == first + steps()
/// @param points steps at which the chain may turn, see turning_points()
/// @return walls of lines that meet at angles of at least 12 degrees; nullopt if there are none @throws
/// Cancelled
[[nodiscard]] std::optional<std::vector<WallSegment>> find_walls(
    const TraceSums& samples, std::size_t first, std::size_t last, const std::vector<std::size_t>& points,
    const WallParameters& parameters, const WallDirections& directions, const StopToken& stop);

}  // namespace d2b::outline
