#pragma once

#include <cstdint>

#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// Divides buildings along boundaries of parcels, or along the cuts of an editor, see cut_by_parcels().
/// @return the pieces before they were merged
Regions divide_along(const Scene& scene, const ParcelGrid& boundaries, double width_m, std::int64_t min_cells,
                     Detection& detection, Executor& threads);

/// Divides buildings along parcel boundaries, and records for each building and doubtful object the parcel
/// with most of its cells. Neighbouring cells stay together if their centres are in one parcel and no
/// boundary passes between them. Parts of a piece narrower than `width_m` are assigned to adjacent pieces,
/// see assign_cells(); pieces with fewer than `min_cells` cells are merged with the neighbour that shares
/// most of their border, as in split_buildings(). Each remaining piece becomes an object with its building's
/// confidence; together they cover exactly the building's cells. Pieces that vanish are recorded as rejected.
/// Halo: buildings. Time O(n log n) for n cells.
/// @pre scene.parcels
void cut_by_parcels(const Scene& scene, double width_m, std::int64_t min_cells, Detection& detection,
                    Executor& threads);

/// Divides buildings at steps of their surface: neighbours that differ by at most `split_height` metres stay
/// together. Pieces with fewer than `min_cells` cells, or so narrow that an opening would remove them
/// (blurred walls), are merged with the neighbour with the longest common border; in case of a tie the one
/// with the nearest mean height, then the first in scan order. Each remaining piece becomes an object with
/// its building's confidence; together they cover exactly the building's cells. Doubtful objects stay whole.
/// Buildings are renumbered in scan order, doubtful objects follow. Halo: buildings. Time O(n log n) for n
/// cells.
void split_buildings(const Scene& scene, double split_height, std::int64_t min_cells, Detection& detection,
                     Executor& threads);

}  // namespace d2b::detect
