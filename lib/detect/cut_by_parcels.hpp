#pragma once

#include <cstdint>

#include "detect/detection.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Cuts buildings where parcels do, and says of each building and doubtful object which parcel holds most of
/// its cells. Neighbours stay together where their middles are of one parcel and no line passes between them.
/// What of a piece is narrower than `width_m`, see settle_pieces(), goes to what lies beside it; a piece with
/// fewer than `least_cells` cells to the one it shares most of its border with, as in split_buildings().
/// What remains is an object each, with its building's confidence; together they cover the building's cells
/// and no others. A piece of which nothing remains is counted among what was left out.
/// Halo: buildings. Time O(n log n) for n cells.
/// @pre scene.parcels
void cut_by_parcels(const Scene& scene, double width_m, std::int64_t least_cells, Detection& detection,
                    Executor& threads);

}  // namespace d2b
