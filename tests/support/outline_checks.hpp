#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/georeference.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"
#include "support/contour_set.hpp"

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

/// Fault of outlines that do not stay valid, nested and disjoint, or lose a hole; else "". The rest
/// of a parent has to be its area less its children's: they lie in it then and do not overlap.
inline std::string nesting_fault(const ContourSet& set, const outline::Outliner& outliner) {
    constexpr double rounding = 1e-9;  // of areas of some hundred cells
    Geos geos;
    std::vector<std::vector<FinePolygon>> children(set.contours.size());
    std::vector<double> children_area(set.contours.size(), 0);
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        const contours::Contour& contour = set.contours[i];
        const FinePolygon polygon = outliner.outline(i);
        std::string fault = geos.invalidity({unit_grid.polygon(polygon)});
        if (fault.empty() && contour.key.level <= 1)
            fault = geos.invalidity({unit_grid.polygon(outliner.footprint(i))});
        if (fault.empty() && planar_area(polygon) <= 0)
            fault = "it has no area";
        if (fault.empty() && polygon.interiors.size() != contour.interiors.size())
            fault = "a hole is lost";
        if (!fault.empty())
            return "contour " + std::to_string(i) + ": " + fault;
        if (contour.parent < 0)
            continue;
        children[static_cast<std::size_t>(contour.parent)].push_back(polygon);
        children_area[static_cast<std::size_t>(contour.parent)] += planar_area(polygon);
    }
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        double left = 0;
        const FinePolygon parent = outliner.outline(i);
        for (const FinePolygon& piece : geos.difference(parent, children[i]))
            left += planar_area(piece);
        if (std::abs(left + children_area[i] - planar_area(parent)) > rounding)
            return "contour " + std::to_string(i) + " does not hold its children side by side";
    }
    return {};
}

}  // namespace d2b::test
