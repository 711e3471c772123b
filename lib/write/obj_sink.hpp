#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Wavefront OBJ: one object per building, named after its id, or one for all, with groups roof, wall and
/// ground, whose colours are in a second file. Vertices shared by touching buildings are written once, before
/// the first of them. Metadata are written as comments. @param materials file of RasterFormat::materials
[[nodiscard]] std::unique_ptr<SurfaceSink> open_obj_sink(RasterPlace place, RasterPlace materials,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b
