#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// ASCII STL: one solid per building, named after its id, or one for all, with the origin of the coordinates
/// after the name. Without any building no file is written, because an STL without facets is invalid, and a
/// warning says so.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_stl_sink(RasterPlace place,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b
