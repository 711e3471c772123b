#pragma once

#include <optional>
#include <string>

#include <gdal.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Sets transform and georeferenced of a raster whose name is set. Without a transform the coordinates are
/// pixels, y up, with a warning. @param advice what to do about a transform that is none
/// @throws InputError singular or not finite
void set_transform(const std::optional<AffineTransform>& transform, const std::string& advice, DemInfo& info,
                   Warnings& warnings);

/// The same from a dataset. @throws InputError also where it is placed by ground control points, rational
/// polynomials or geolocation arrays only
void read_transform(GDALDatasetH dataset, DemInfo& info, Warnings& warnings);

}  // namespace d2b
