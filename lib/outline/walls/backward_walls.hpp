#pragma once

#include <cstddef>
#include <vector>

#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Removes walls that run backwards between their corners, because lines cross far from where the trace
/// turns; their neighbours meet, or become one wall if they are parallel.
/// @param end last step of an open chain; of a closed one, the number of its steps
void remove_backward_walls(bool closed, std::size_t end, std::vector<WallSegment>& walls);

}  // namespace d2b::outline
