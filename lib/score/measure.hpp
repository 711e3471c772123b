#pragma once

#include <span>

#include "dem2buildings/sinks.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

// Units are those of the coordinates and their squares.

/// Area of the exterior minus interiors, whatever the orientation of rings.
[[nodiscard]] double area_of(const WorldPolygon& polygon);
[[nodiscard]] double area_of(std::span<const WorldPolygon> polygons);

/// Number of vertices of all rings. @param closing counts the repetition of the first position
[[nodiscard]] std::size_t vertex_count(std::span<const WorldPolygon> polygons, bool closing);

/// Rings as closed lines.
[[nodiscard]] std::vector<Polyline> rings_of(std::span<const WorldPolygon> polygons);

}  // namespace d2b
