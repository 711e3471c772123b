#pragma once

#include <algorithm>
#include <cmath>

#include "core/georeference.hpp"

namespace d2b::test {

inline const Georeference unit_grid({0, 1, 0, 0, 0, -1}, TraceMode::cells);

inline double planar_area(const FinePolygon& polygon) {
    double sum = 0;
    const auto add = [&](const FineRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Position a = unit_grid.position(ring[i]);
            const Position b = unit_grid.position(ring[(i + 1) % ring.size()]);
            sum += (a.x * b.y - b.x * a.y) / 2;
        }
    };
    add(polygon.exterior);
    for (const FineRing& ring : polygon.interiors)
        add(ring);
    return sum;
}

inline double distance(Position p, Position a, Position b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Largest distance from the points of one ring, and points along its edges, to the other ring.
inline double one_sided(const FineRing& from, const FineRing& to) {
    double largest = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        for (int k = 0; k < 16; ++k) {
            const Position a = unit_grid.position(from[i]);
            const Position b = unit_grid.position(from[(i + 1) % from.size()]);
            const Position p{a.x + (b.x - a.x) * k / 16, a.y + (b.y - a.y) * k / 16};
            double nearest = 1e9;
            for (std::size_t j = 0; j < to.size(); ++j)
                nearest = std::min(nearest, distance(p, unit_grid.position(to[j]),
                                                     unit_grid.position(to[(j + 1) % to.size()])));
            largest = std::max(largest, nearest);
        }
    return largest;
}

}  // namespace d2b::test
