#include "score/measure.hpp"

#include <cmath>

namespace d2b {
namespace {

/// Relative to the first position, because large coordinates would cancel the area.
double ring_area(const WorldRing& ring) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        twice += (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) -
                 (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
    return std::abs(twice) / 2;
}

Polyline closed(const WorldRing& ring) {
    Polyline line = ring;
    if (!line.empty())
        line.push_back(ring.front());
    return line;
}

}  // namespace

double area_of(const WorldPolygon& polygon) {
    double area = ring_area(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors)
        area -= ring_area(interior);
    return area;
}

double area_of(std::span<const WorldPolygon> polygons) {
    double area = 0;
    for (const WorldPolygon& polygon : polygons)
        area += area_of(polygon);
    return area;
}

std::size_t vertex_count(std::span<const WorldPolygon> polygons, bool closing) {
    const std::size_t more = closing ? 1 : 0;
    std::size_t count = 0;
    for (const WorldPolygon& polygon : polygons) {
        count += polygon.exterior.size() + more;
        for (const WorldRing& interior : polygon.interiors)
            count += interior.size() + more;
    }
    return count;
}

std::vector<Polyline> rings_of(std::span<const WorldPolygon> polygons) {
    std::vector<Polyline> lines;
    for (const WorldPolygon& polygon : polygons) {
        lines.push_back(closed(polygon.exterior));
        for (const WorldRing& interior : polygon.interiors)
            lines.push_back(closed(interior));
    }
    return lines;
}

}  // namespace d2b
