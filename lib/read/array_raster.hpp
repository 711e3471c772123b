#pragma once

#include "dem2buildings/open_sources.hpp"
#include "read/open_raster.hpp"

namespace d2b {

/// Copies an array into a raster in memory of GDAL, with NaN for values that are masked or not finite.
/// @param grid gives rows, columns, transform and plane CRS. The copy has no vertical CRS, so that elevations
/// are taken in the unit of the DEM
[[nodiscard]] OpenRaster array_raster(const ElevationArray& array, const DemInfo& grid);

}  // namespace d2b
