#pragma once

#include <cstdint>
#include <vector>

namespace d2b {

/// A position in a CRS, in the order that GIS programs use: x is easting or longitude, y northing or
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
    std::uint32_t edges = 0;  ///< to its end, at least two; round the ring's end where need be
};

/// The last position is not repeated.
using WorldRing = std::vector<Position>;

/// Exterior ring counter-clockwise, interior rings clockwise (y up).
struct WorldPolygon {
    WorldRing exterior;
    std::vector<WorldRing> interiors;
    std::vector<CircularArc> arcs = {};  ///< runs of vertices that stand for circular arcs
};

}  // namespace d2b
