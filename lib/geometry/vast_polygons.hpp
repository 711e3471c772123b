#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// To find out whether a polygon is valid, GEOS 3.11 compares a point of each hole with every edge of the
/// exterior ring, in one go that nothing stops: a thousand million comparisons and more for a polygon of a
/// raster's size. Everything else it finds with an index. So polygons with many holes and a long exterior
/// ring are turned inside out: what lies around them, with the exterior ring as its only hole, and each hole
/// as a polygon. Rings that cross, and holes that lie outside or in others, are found in these just as well.
[[nodiscard]] bool is_vast(const WorldPolygon& polygon);

/// @param polygon finite
[[nodiscard]] std::vector<WorldPolygon> inside_out(const WorldPolygon& polygon);

/// What that does not tell: whether rings that touch in points part the polygon's inside.
/// @return such a point; nothing where the inside is connected
[[nodiscard]] std::optional<Position> parted_at(const WorldPolygon& polygon);

/// Polygons with those of their holes in which another one could lie: whether they overlap does not depend on
/// the others.
[[nodiscard]] std::vector<WorldPolygon> without_empty_holes(std::span<const WorldPolygon> polygons);

}  // namespace d2b
