#pragma once

#include "core/grid.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// Parcels of the cells of a scene.
using ParcelGrid = Grid<ParcelCell>;

/// True if a parcel boundary separates two neighbours.
/// @param below true if the second cell is below the first, false if it is to the right
[[nodiscard]] inline bool parted(const ParcelCell& first, const ParcelCell& second, bool below) {
    return first.parcel != second.parcel || (below ? first.cut_below : first.cut_right);
}

}  // namespace d2b
