#pragma once

#include <optional>
#include <vector>

#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Rectangle with the area, the centroid and the proportions of a closed chain, for rings too small for a
/// path.
/// @param frame direction of its sides in radians
/// @return nullopt if its corners are not near four steps in the order of the chain
[[nodiscard]] std::optional<std::vector<WallSegment>> fit_rectangle(const TraceSums& samples, double frame);

}  // namespace d2b::outline
