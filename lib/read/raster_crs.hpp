#pragma once

#include <string>

#include <gdal.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Sets crs_wkt: what the user gave, else the raster's own; "" and a warning where there is none, or where it
/// is one of degrees and the coordinates are pixels. After set_transform().
/// @param own_wkt the raster's own; "" for none
/// @param user_crs anything that names a CRS without a file or the network being read; "" for the raster's
/// @throws OptionError where user_crs is no CRS, or has no plane; InputError where the raster's has none
void set_crs(const std::string& own_wkt, const std::string& user_crs, DemInfo& info, Warnings& warnings);

/// The same from a dataset.
void read_crs(GDALDatasetH dataset, const std::string& user_crs, DemInfo& info, Warnings& warnings);

/// As WKT; "" where it is null, empty, stands for an unknown one (as in a GeoPackage) or cannot be written
/// so.
[[nodiscard]] std::string wkt_of(OGRSpatialReferenceH crs);

/// The CRS without its heights, axes in GIS order: heights play no part where cells are placed, and could
/// make PROJ ask for vertical grids. @param wkt "" gives null
[[nodiscard]] CrsOwner horizontal_crs(const std::string& wkt);

}  // namespace d2b
