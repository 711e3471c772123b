#pragma once

#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// An ASCII STL: a solid a building, named after its number, with the origin of the coordinates after the
/// name. Without a building there is no file, since an STL without facets is none, and a warning says so.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_stl_sink(RasterPlace place);

}  // namespace d2b
