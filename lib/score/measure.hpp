#pragma once

#include <span>

#include "dem2buildings/sinks.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

// All in the units of the coordinates and their squares.

/// Exterior less interiors, whatever way the rings run.
[[nodiscard]] double area_of(const WorldPolygon& polygon);
[[nodiscard]] double area_of(std::span<const WorldPolygon> polygons);

/// Of all rings. @param closing whether the repetition of a ring's first position counts
[[nodiscard]] std::size_t vertex_count(std::span<const WorldPolygon> polygons, bool closing);

/// The rings as closed lines.
[[nodiscard]] std::vector<Polyline> rings_of(std::span<const WorldPolygon> polygons);

}  // namespace d2b
