#pragma once

#include <string>

#include <gdal.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Sets crs_wkt to the CRS given by the user, otherwise to that of the raster. Sets "" and warns if there is
/// none, or if it is in degrees although coordinates are pixels. @pre set_transform() was called
/// @param own_wkt CRS of the raster; "" for none
/// @param user_crs any definition of a CRS that needs neither files nor network; "" for that of the raster
/// @throws OptionError if user_crs is not a CRS or has no plane; InputError if that of the raster has none
void set_crs(const std::string& own_wkt, const std::string& user_crs, DemInfo& info, Warnings& warnings);

/// Same, from a dataset.
void read_crs(GDALDatasetH dataset, const std::string& user_crs, DemInfo& info, Warnings& warnings);

/// Returns a CRS as WKT, or "" if it is null, empty, a placeholder for an unknown CRS (as in a GeoPackage) or
/// not expressible as WKT.
[[nodiscard]] std::string wkt_of(OGRSpatialReferenceH crs);

/// Returns the CRS without heights, axes in GIS order. Heights do not affect the positions of cells and could
/// make PROJ ask for vertical grids. @param wkt "" gives null
[[nodiscard]] CrsOwner horizontal_crs(const std::string& wkt);

}  // namespace d2b
