#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <gdal.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

/// Sets transform and georeferenced of a raster whose name is set. Without a transform, warns and uses pixels
/// as coordinates, y up. @param advice remedy for an invalid transform
/// @throws InputError singular or not finite
void set_transform(const std::optional<AffineTransform>& transform, const std::string& advice, DemInfo& info,
                   Warnings& warnings);

/// Same, from a dataset. @throws InputError also if it is located only by ground control points, rational
/// polynomials or geolocation arrays
void read_transform(GDALDatasetH dataset, DemInfo& info, Warnings& warnings);

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

/// Returns the part of a raster selected by the options: all of it, or one of source_window, projected_window
/// and extent. For an area in coordinates, cells whose centres lie inside are taken. A centre on the west or
/// south edge is inside and one on the east or north edge is outside, so that neighbouring windows share no
/// cell.
/// @param info rows, cols and transform of the whole raster
/// @throws OptionError if more than one window is given, or one that does not fit the raster
[[nodiscard]] Window choose_window(const ReadOptions& options, const DemInfo& info);

/// Returns a warning if an extent probably has QGIS order, in which both x come before both y; "" otherwise.
[[nodiscard]] std::string extent_order_warning(const ReadOptions& options, const DemInfo& info);

/// Checks a part and its buffer. @param size of the buffer @throws InputError if the part does not lie inside
/// of the window or the buffer has another size
void require_part(const DemInfo& info, const Window& part, std::size_t size);

}  // namespace d2b::reading
