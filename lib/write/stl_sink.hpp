#pragma once

#include <memory>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// An ASCII STL: a solid for each building, named after its number, or one for all, with the origin of the
/// coordinates after the name. Without a building there is no file, since an STL without facets is none, and
/// a warning says so.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_stl_sink(RasterPlace place,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b
