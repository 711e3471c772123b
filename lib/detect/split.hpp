#pragma once

#include <cstdint>

#include "detect/detection.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Divides buildings where their surface steps: neighbours whose surface differs by at most `split_height`
/// metres stay together. Pieces with fewer than `least_cells` cells, or so narrow that an opening would take
/// them (walls that the raster smears), go to the neighbour with the longest common border; of equal ones to
/// the one whose mean height is nearest, then to the first in scan order. What remains is an object each,
/// with its building's confidence; together they cover the building's cells and no others. Doubtful objects
/// stay whole. Buildings are numbered anew in scan order, doubtful objects follow. Halo: buildings. Time
/// O(n log n) for n cells.
void split_buildings(const Scene& scene, double split_height, std::int64_t least_cells, Detection& detection,
                     Executor& threads);

}  // namespace d2b
