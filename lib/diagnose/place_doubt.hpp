#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Why a raster may be a picture and no surface: three bands, or byte values. Without a full stop; "" where
/// it has neither.
[[nodiscard]] std::string picture_doubt(const DemInfo& dem);

/// Why coordinates may be degrees that nothing says are: there is no CRS, they lie within 180 of 0, and cells
/// are as small as those of buildings are in degrees. "" where they are none.
[[nodiscard]] std::string degrees_doubt(const DemInfo& dem, bool has_crs);

/// Why no building has room in the raster: it covers less than one. "" where it covers more.
/// @param width, height metres
[[nodiscard]] std::string extent_doubt(const std::string& dem, double width, double height);

}  // namespace d2b
