#pragma once

#include <memory>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Opens a band of any raster that GDAL reads as a DEM. /vsistdin/ is kept in a temporary file first.
/// @throws InputError: cannot be opened, no such band, complex values, a singular transform, GCPs only, an
/// unusable cutline. @throws OptionError: options that do not fit the raster, or a window outside of it
[[nodiscard]] std::unique_ptr<DemSource> open_dem(const ReadOptions& options,
                                                  const Callbacks& callbacks = {});

}  // namespace d2b
