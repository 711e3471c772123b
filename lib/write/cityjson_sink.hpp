#pragma once

#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// CityJSON 2.0: a Building with a Solid each, or where it is divided a Building with a BuildingPart and a
/// Solid for each of its parts. Surfaces know whether they are roof, wall or ground,
/// and objects with a Solid have the attributes of the layer. Vertices are the whole numbers of SurfacePoint,
/// and the transform is the frame's. Refuses coordinates whose heights are in another unit than x and y, or
/// in one that nobody knows.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_cityjson_sink(RasterPlace place);

}  // namespace d2b
