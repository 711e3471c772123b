#pragma once

#include <memory>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/correction_source.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b::reading {

/// Source of an editor's corrections.
struct CorrectionChoice {
    std::string dataset;  ///< anything with points, lines or polygons that GDAL opens
    std::string layer;    ///< "": all layers with geometries and a field `kind`
};

/// Reads all corrections and finds their cells in the window of a DEM. Features of an unknown kind, or whose
/// geometry does not suit it, are counted and named in a warning.
/// @throws InputError: cannot be opened or read, no layer with a field `kind`, a CRS although the DEM has
/// none, or one that cannot be converted to that of the DEM
/// @throws OptionError: no such layer, or it has no field `kind`
[[nodiscard]] std::unique_ptr<CorrectionSource> open_corrections(const CorrectionChoice& choice,
                                                                 const DemInfo& grid,
                                                                 const Callbacks& callbacks = {});

}  // namespace d2b::reading
