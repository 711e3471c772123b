#pragma once

#include <memory>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/footprint_source.hpp"

namespace d2b::reading {

/// Source of footprints.
struct FootprintChoice {
    std::string dataset;     ///< anything with polygons that GDAL opens
    std::string layer;       ///< "": first layer with geometries, with a warning if there are several
    std::string target_crs;  ///< WKT of the CRS of the output; "": that of the footprints
};

/// Opens footprints for a DEM.
/// @throws InputError: cannot be opened, no features, a CRS although the DEM has none, or one that cannot be
/// converted to that of the DEM or of the output
/// @throws OptionError: no such layer
[[nodiscard]] std::unique_ptr<FootprintSource> open_footprints(const FootprintChoice& choice,
                                                               const DemInfo& dem,
                                                               const Callbacks& callbacks = {});

}  // namespace d2b::reading
