#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A Wavefront OBJ: an object for each building, named after its number, or one for all, with the groups
/// roof, wall and ground, whose colours stand in a second file.
/// Corners that touching buildings share stand there once, before the first of these. What the metadata say
/// stands in comments.
/// @param materials of RasterFormat::materials
[[nodiscard]] std::unique_ptr<SurfaceSink> open_obj_sink(RasterPlace place, RasterPlace materials,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b
