#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// True if validating a polygon with GEOS would take too long. GEOS 3.11 compares a point of each hole with
/// every edge of the exterior ring, without an index and without checking for interrupts: more than 10^9
/// comparisons for a polygon of the size of a raster. Polygons with many holes and a long exterior ring are
/// therefore turned inside out: a frame with the exterior ring as its only hole, and each hole as a polygon.
/// Crossing rings and holes that lie outside or in other holes are found in that form as well.
[[nodiscard]] bool is_vast(const WorldPolygon& polygon);

/// @param polygon finite
[[nodiscard]] std::vector<WorldPolygon> inside_out(const WorldPolygon& polygon);

/// Tests the property that inside_out() loses: rings that touch in points must not disconnect the interior.
/// @return a point at which they do; nullopt if the interior is connected
[[nodiscard]] std::optional<Position> parted_at(const WorldPolygon& polygon);

/// Removes holes that cannot contain another polygon, because the result of the overlap test does not depend
/// on them.
[[nodiscard]] std::vector<WorldPolygon> without_empty_holes(std::span<const WorldPolygon> polygons);

}  // namespace d2b
