#pragma once

#include <optional>
#include <string>

#include <gdal.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Sets transform and georeferenced of a raster whose name is set. Without a transform, warns and uses pixels
/// as coordinates, y up. @param advice remedy for an invalid transform
/// @throws InputError singular or not finite
void set_transform(const std::optional<AffineTransform>& transform, const std::string& advice, DemInfo& info,
                   Warnings& warnings);

/// Same, from a dataset. @throws InputError also if it is located only by ground control points, rational
/// polynomials or geolocation arrays
void read_transform(GDALDatasetH dataset, DemInfo& info, Warnings& warnings);

}  // namespace d2b
