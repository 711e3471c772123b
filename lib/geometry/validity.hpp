#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "geometry/geos_polygons.hpp"

namespace d2b {

/// Reason and position if the polygons are invalid; "" if they form a valid MultiPolygon with finite
/// positions. Vast polygons are tested inside out (vast_polygons.hpp). @throws Cancelled
[[nodiscard]] std::string invalidity(const GeosPolygons& geos, std::span<const WorldPolygon> polygons);

/// Repairs polygons with GEOSMakeValid, structure method: the area within an exterior ring and outside its
/// holes, whatever the orientation and crossings of rings. Overlaps are merged. May be empty.
/// @param polygons rings of at least three finite positions @throws GeometryError, Cancelled
[[nodiscard]] std::vector<WorldPolygon> repaired(const GeosPolygons& geos,
                                                 std::span<const WorldPolygon> polygons);

}  // namespace d2b
