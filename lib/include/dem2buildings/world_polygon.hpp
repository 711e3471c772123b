#pragma once

#include <cstdint>
#include <vector>

namespace d2b {

/// Position in a CRS, in the axis order of GIS programs: x is easting or longitude, y is northing or
/// latitude.
struct Position {
    double x = 0;
    double y = 0;

    friend bool operator==(const Position&, const Position&) = default;
};

/// Vertices of a ring that lie on one circular arc.
struct CircularArc {
    std::uint32_t ring = 0;   ///< 0: the exterior, then the interiors
    std::uint32_t first = 0;  ///< vertex at which it begins
    std::uint32_t edges = 0;  ///< number of edges, at least two; may continue past the ring's last vertex
};

/// Ring without repetition of the first position.
using WorldRing = std::vector<Position>;

/// Exterior ring counter-clockwise, interior rings clockwise (y up).
struct WorldPolygon {
    WorldRing exterior;
    std::vector<WorldRing> interiors;
    std::vector<CircularArc> arcs = {};  ///< runs of vertices that represent circular arcs
    /// Elevations of the vertices, of the exterior and then of the interiors; empty if all have that of their
    /// feature.
    std::vector<double> elevations = {};
};

}  // namespace d2b
