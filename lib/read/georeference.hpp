#pragma once

#include <string>

#include <gdal.h>

#include "core/context.hpp"
#include "core/dem_info.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Sets transform and georeferenced from a raster whose name is set. Without a transform the coordinates are
/// pixels, y up, with a warning. @throws InputError singular or not finite; ground control points only
void read_transform(GDALDatasetH dataset, DemInfo& info, Context& context);

/// Sets crs_wkt: what the user gave, else the raster's own; "" and a warning where there is none.
/// @param user_crs anything that names a CRS without a file or the network being read; "" for the raster's
/// @throws OptionError where user_crs is no CRS
void read_crs(GDALDatasetH dataset, const std::string& user_crs, DemInfo& info, Context& context);

/// The CRS without its heights, axes in GIS order: heights play no part where cells are placed, and could
/// make PROJ ask for vertical grids. @param wkt "" gives null
[[nodiscard]] CrsOwner horizontal_crs(const std::string& wkt);

}  // namespace d2b
