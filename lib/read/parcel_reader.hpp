#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::reading {

/// Feature in pixel coordinates of a DEM: x is columns, y is rows, (0, 0) the outer corner of the first cell.
struct PixelParcel {
    std::int64_t number = ParcelCell::no_parcel;
    bool valid = true;
    std::vector<std::vector<WorldRing>> polygons;  ///< closed rings under the even-odd rule
    std::vector<WorldRing> lines;
};

/// Rasterises a parcel: cells whose centres its polygons cover get its number unless they already have one,
/// and neighbours are separated if a line passes between their centres. Each crossing depends on the edge and
/// the row alone, so that it is the same from both sides and for every part: parcels that share an edge leave
/// no gap and do not overlap.
/// @param cells of the part, row by row
void burn(const PixelParcel& parcel, const Window& part, std::span<ParcelCell> cells);

/// Source of parcels.
struct ParcelChoice {
    std::string dataset;  ///< anything with polygons or lines that GDAL opens
    std::string layer;    ///< "": first layer with geometries, with a warning if there are several
    std::string field;    ///< identifies a parcel; "": feature id
};

/// Opens parcels on the grid of a DEM. Only parcels around the current part are held in memory; only names of
/// the others are kept.
/// @throws InputError: cannot be opened, a CRS although the DEM has none, or no parcel in the DEM's window
/// @throws OptionError: no such layer or field
[[nodiscard]] std::unique_ptr<ParcelSource> open_parcels(const ParcelChoice& choice, const DemInfo& grid,
                                                         const Callbacks& callbacks = {});

}  // namespace d2b::reading
