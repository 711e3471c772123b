#pragma once

#include <vector>

#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_directions.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Moves the line of a wall to the mean of the midpoints that lie near it.
void fit_offset(const TraceSums& samples, WallSegment& wall);

/// Turns frames to the walls that follow them, by least squares over the midpoints of their steps.
/// @return largest turn in radians
double adjust_frames(const TraceSums& samples, const std::vector<WallSegment>& walls,
                     WallDirections& directions);

/// Turns walls from their directions to others that differ slightly, about the middle of their steps.
void turn_walls(const TraceSums& samples, const WallDirections& from, const WallDirections& to,
                std::vector<WallSegment>& walls);

/// Joins parallel walls with jogs between them to one wall, turned by a few degrees, where that costs less by
/// the prices of find_walls(). Needed because the walls of a frame have one direction, while those of a
/// building differ by a degree or two: a long wall would be drawn as a flight of steps.
///
/// Do not use it where all corners have to be right angles.
/// @param walls of a chain, in its order; nothing is done to arcs and walls on the edge of the raster
void join_parallel_walls(const TraceSums& samples, const WallParameters& parameters,
                         std::vector<WallSegment>& walls);

}  // namespace d2b::outline
