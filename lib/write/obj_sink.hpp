#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A Wavefront OBJ: an object for each building, named after its number, or one for all, with the groups
/// roof, wall and ground.
/// Corners that touching buildings share stand there once, before the first of these. What the metadata say
/// stands in comments.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_obj_sink(RasterPlace place,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b
