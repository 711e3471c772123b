#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_graph.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Returns the walls of a chain along the edge of the raster, in order. They are known: the raster cuts the
/// building off there, whatever directions it has.
/// @param frame of the raster
[[nodiscard]] std::vector<WallSegment> walls_on_frame(const Chain& chain, const TraceSums& samples,
                                                      const LatticeBox& frame);

/// True if the middle of a range of steps is on one of the walls.
[[nodiscard]] inline bool is_on(const std::vector<WallSegment>& walls, std::size_t first, std::size_t last) {
    const std::size_t middle = (first + last) / 2;
    return std::ranges::any_of(
        walls, [&](const WallSegment& wall) { return middle >= wall.first && middle < wall.last; });
}

}  // namespace d2b::outline
