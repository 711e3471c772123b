#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "geometry/geos_converter.hpp"

namespace d2b {

/// True if validating a polygon with GEOS would take too long. GEOS 3.11 compares a point of each hole with
/// every edge of the exterior ring, without an index and without checking for interrupts: more than 10^9
/// comparisons for a polygon of the size of a raster. Polygons with many holes and a long exterior ring are
/// therefore turned inside out: a frame with the exterior ring as its only hole, and each hole as a polygon.
/// Crossing rings and holes that lie outside or in other holes are found in that form as well.
[[nodiscard]] bool needs_inside_out_check(const WorldPolygon& polygon);

/// @param polygon finite
[[nodiscard]] std::vector<WorldPolygon> inside_out(const WorldPolygon& polygon);

/// Tests the property that inside_out() loses: rings that touch in points must not disconnect the interior.
/// @return a point at which they do; nullopt if the interior is connected
[[nodiscard]] std::optional<Position> disconnected_at(const WorldPolygon& polygon);

/// Removes holes that cannot contain another polygon, because the result of the overlap test does not depend
/// on them.
[[nodiscard]] std::vector<WorldPolygon> without_empty_holes(std::span<const WorldPolygon> polygons);

/// Reason and position if the polygons are invalid; "" if they form a valid MultiPolygon with finite
/// positions. Vast polygons are tested inside out (vast_polygons.hpp). @throws Cancelled
[[nodiscard]] std::string invalidity(const GeosConverter& geos, std::span<const WorldPolygon> polygons);

/// Repairs polygons with GEOSMakeValid, structure method: the area within an exterior ring and outside its
/// holes, whatever the orientation and crossings of rings. Overlaps are merged. May be empty.
/// @param polygons rings of at least three finite positions @throws GeometryError, Cancelled
[[nodiscard]] std::vector<WorldPolygon> repaired(const GeosConverter& geos,
                                                 std::span<const WorldPolygon> polygons);

}  // namespace d2b
