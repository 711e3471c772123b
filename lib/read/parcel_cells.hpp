#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A feature in pixel coordinates of a DEM: x is columns, y is rows, (0, 0) the outer corner of the first
/// cell.
struct PixelParcel {
    std::int64_t number = ParcelCell::nobody;
    bool valid = true;
    std::vector<std::vector<WorldRing>>
        polygons;  ///< closed rings; inside of an odd number of them is inside
    std::vector<WorldRing> lines;
};

/// Says of the cells of a part whose middles a parcel's polygons cover that they are its own, where they are
/// nobody's so far, and which neighbours its lines part: those between whose middles a line passes. Where an
/// edge lies between middles is worked out from the edge and the row alone, the same from either side and for
/// every part: neighbours that share an edge leave out no cell and share none.
/// @param cells of the part, row by row
void burn(const PixelParcel& parcel, const Window& part, std::span<ParcelCell> cells);

}  // namespace d2b
