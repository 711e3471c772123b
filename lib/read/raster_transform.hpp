#pragma once

#include <gdal.h>

#include "core/context.hpp"
#include "dem2buildings/dem_info.hpp"

namespace d2b {

/// Sets transform and georeferenced from a raster whose name is set. Without a transform the coordinates are
/// pixels, y up, with a warning. @throws InputError singular or not finite; placed by ground control points,
/// rational polynomials or geolocation arrays only
void read_transform(GDALDatasetH dataset, DemInfo& info, Context& context);

}  // namespace d2b
