#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/score.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b::score {

/// Rings of a polygon without vertices on straight walls, so that all vertices are corners.
using CornerRings = std::vector<WorldRing>;

/// The ring from its lowest vertex of those farthest left on. That is a vertex of the convex hull, which a
/// simplification that keeps the first vertex should keep. @param ring not empty
[[nodiscard]] WorldRing from_leftmost(const WorldRing& ring);

/// Angles in degrees, lengths in units of the coordinates.
struct ShapeLimits {
    double near_deg = 3;               ///< angles that differ by less are taken as equal
    double sharp_deg = 45;             ///< walls that enclose less are a sharp corner
    std::optional<double> short_edge;  ///< edges below it are short; nullopt: not counted
};

/// Direction modulo 90 degrees with the most outline less than `near_deg` from it.
struct MainDirection {
    double degrees = 0;  ///< of the longest such edge, at least 0, below 90
    double along = 0;    ///< length of that outline
    double length = 0;   ///< length of the whole outline
};
[[nodiscard]] MainDirection main_direction(const CornerRings& polygon, double near_deg);

/// Smallest angle between two directions modulo 90 degrees: at most 45.
[[nodiscard]] double angle_between(double degrees, double other_degrees);

/// Counts corners and edges. @param polygons each as its corners
[[nodiscard]] ShapeScore measure_shape(std::span<const CornerRings> polygons, const ShapeLimits& limits);

/// Median and 90th percentile, both interpolated between ranks. @return nullopt if there are no angles
[[nodiscard]] std::optional<DirectionErrors> direction_errors(std::vector<double> angles);

}  // namespace d2b::score
