#pragma once

#include <cstdint>

#include "detect/detection.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Divides buildings along parcel boundaries, and records for each building and doubtful object the parcel
/// with most of its cells. Neighbouring cells stay together if their centres are in one parcel and no
/// boundary passes between them. Parts of a piece narrower than `width_m` are assigned to adjacent pieces,
/// see settle_pieces(); pieces with fewer than `least_cells` cells are merged with the neighbour that shares
/// most of their border, as in split_buildings(). Each remaining piece becomes an object with its building's
/// confidence; together they cover exactly the building's cells. Pieces that vanish are recorded as rejected.
/// Halo: buildings. Time O(n log n) for n cells.
/// @pre scene.parcels
void cut_by_parcels(const Scene& scene, double width_m, std::int64_t least_cells, Detection& detection,
                    Executor& threads);

}  // namespace d2b
