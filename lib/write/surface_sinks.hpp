#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A file of a surface, in the format that its name ends in. @param place of RasterFormat::surface
/// @param solids of an OBJ or STL
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(RasterPlace place, SurfaceSolids solids);

}  // namespace d2b
