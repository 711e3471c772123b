#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "geometry/geos_polygons.hpp"

namespace d2b {

/// What makes polygons invalid, with the place; "" where they are a valid MultiPolygon of finite positions.
/// Where one is vast it is looked at inside out (vast_polygons.hpp). @throws Cancelled
[[nodiscard]] std::string invalidity(const GeosPolygons& geos, std::span<const WorldPolygon> polygons);

/// What the polygons cover, by GEOS's structural repair: what lies within an exterior ring and in none of its
/// holes, however the rings run and cross. What they cover twice is covered once. May be empty.
/// @param polygons rings of at least three finite positions @throws GeometryError, Cancelled
[[nodiscard]] std::vector<WorldPolygon> repaired(const GeosPolygons& geos,
                                                 std::span<const WorldPolygon> polygons);

}  // namespace d2b
