#pragma once

#include <vector>

#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Joins parallel walls with jogs between them to one wall, turned by a few degrees, where that costs less by
/// the prices of find_walls(). Needed because the walls of a frame have one direction, while those of a
/// building differ by a degree or two: a long wall would be drawn as a flight of steps.
///
/// Do not use it where all corners have to be right angles.
/// @param walls of a chain, in its order; nothing is done to arcs and walls on the edge of the raster
void join_parallel_walls(const TraceSums& samples, const WallParameters& parameters,
                         std::vector<WallSegment>& walls);

}  // namespace d2b::outline
