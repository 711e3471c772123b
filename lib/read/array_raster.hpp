#pragma once

#include "dem2buildings/open_sources.hpp"
#include "read/open_raster.hpp"

namespace d2b {

/// A copy of an array as a raster that GDAL has in memory, with NaN where a value is masked or not finite.
/// @param grid whose rows, columns, transform and plane CRS it gets; it has no vertical CRS, so that
/// elevations are taken in the DEM's unit
[[nodiscard]] OpenRaster array_raster(const ElevationArray& array, const DemInfo& grid);

}  // namespace d2b
