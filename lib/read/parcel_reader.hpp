#pragma once

#include <memory>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// What parcels are read from.
struct ParcelChoice {
    std::string dataset;  ///< anything with polygons or lines that GDAL opens
    std::string layer;    ///< "": the first that has geometries, with a warning where there are several
    std::string field;    ///< that identifies a parcel; "": the feature's id
};

/// Opens parcels on the grid of a DEM. Only those around a part are in memory while it is read; of the rest
/// the names are kept.
/// @throws InputError cannot be opened, a CRS where the DEM has none, or nothing of it in the DEM's window.
/// @throws OptionError no such layer or field
[[nodiscard]] std::unique_ptr<ParcelSource> open_parcels(const ParcelChoice& choice, const DemInfo& grid,
                                                         const Callbacks& callbacks = {});

}  // namespace d2b
