#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Returns the reason why a raster may be a picture and not a surface: three bands, or byte values. A clause
/// without a full stop; "" if it has neither.
[[nodiscard]] std::string picture_doubt(const DemInfo& dem);

/// Returns the reason why coordinates may be undeclared degrees: there is no CRS, they lie within 180 of 0,
/// and cells have the size of typical cells in degrees. "" if they are not degrees.
[[nodiscard]] std::string degrees_doubt(const DemInfo& dem, bool has_crs);

/// Returns a warning if the raster is smaller than a building; "" if it is larger.
/// @param width, height extent in m
[[nodiscard]] std::string extent_doubt(const std::string& dem, double width, double height);

}  // namespace d2b
