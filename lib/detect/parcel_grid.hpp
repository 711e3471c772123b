#pragma once

#include "core/grid.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// What parcels are to the cells of a scene.
using ParcelGrid = Grid<ParcelCell>;

/// Whether parcels part two neighbours. @param below the second is below the first, else beside it
[[nodiscard]] inline bool parted(const ParcelCell& first, const ParcelCell& second, bool below) {
    return first.parcel != second.parcel || (below ? first.cut_below : first.cut_right);
}

}  // namespace d2b
