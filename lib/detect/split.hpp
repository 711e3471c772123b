#pragma once

#include <cstdint>

#include "detect/detection.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Divides buildings at steps of their surface: neighbours that differ by at most `split_height` metres stay
/// together. Pieces with fewer than `least_cells` cells, or so narrow that an opening would remove them
/// (blurred walls), are merged with the neighbour with the longest common border; in case of a tie the one
/// with the nearest mean height, then the first in scan order. Each remaining piece becomes an object with
/// its building's confidence; together they cover exactly the building's cells. Doubtful objects stay whole.
/// Buildings are renumbered in scan order, doubtful objects follow. Halo: buildings. Time O(n log n) for n
/// cells.
void split_buildings(const Scene& scene, double split_height, std::int64_t least_cells, Detection& detection,
                     Executor& threads);

}  // namespace d2b
