#pragma once

#include <memory>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

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

}  // namespace d2b
