#pragma once

#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// CityJSON 2.0. An undivided building is a Building with one Solid, a divided one is a Building with one
/// BuildingPart and Solid per part. Surfaces are marked as roof, wall or ground; objects with a Solid have
/// the attributes of the layer. Vertices are the integers of SurfacePoint, and the transform is that of the
/// frame. Throws an OptionError if heights are in another unit than x and y, or in an unknown one, because
/// CityJSON has one unit for all coordinates.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_cityjson_sink(FileDestination place);

}  // namespace d2b::writing
