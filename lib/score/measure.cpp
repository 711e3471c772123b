#include "score/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b::score {
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

/// Edges get a vertex every 64th of the box, because this reduces their curvature error to a 4096th.
constexpr double parts_of_box = 64;

void for_each_ring(Polygons& polygons, const std::function<void(WorldRing&)>& visit) {
    for (WorldPolygon& polygon : polygons) {
        visit(polygon.exterior);
        for (WorldRing& interior : polygon.interiors)
            visit(interior);
    }
}

/// Returns true if coordinates must be transformed; warns if only one side has a CRS.
bool needs_transformation(const MeasurePlane& plane, const Crs& from, const std::string& name,
                          Warnings& warnings) {
    const bool plane_has = plane.crs.kind() != Crs::Kind::none;
    const bool from_has = from.kind() != Crs::Kind::none;
    if (plane_has != from_has)
        warnings.add("'" + name + "' has " + (from_has ? "a" : "no") +
                     " coordinate reference system and the other dataset has " +
                     (plane_has ? "one" : "none") + "; its coordinates are taken as they are.");
    return plane_has && from_has && plane.crs.wkt() != from.wkt();
}

std::vector<Position> corners(const Box& box) {
    return {{box.left, box.low}, {box.right, box.low}, {box.right, box.high}, {box.left, box.high}};
}

WorldRing densified(const WorldRing& ring, double longest) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position a = ring[i];
        const Position b = ring[(i + 1) % ring.size()];
        constexpr double most = 1e6;
        const auto parts =
            static_cast<int>(std::clamp(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / longest), 1.0, most));
        for (int k = 0; k < parts; ++k) {
            const double share = static_cast<double>(k) / parts;
            result.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
        }
    }
    return result;
}

}  // namespace

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

double share(std::size_t part, std::size_t whole) {
    return share(static_cast<double>(part), static_cast<double>(whole));
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void translate(Polygons& polygons, double right, double up) {
    for_each_ring(polygons, [&](WorldRing& ring) {
        for (Position& p : ring)
            p = {p.x + right, p.y + up};
    });
}

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

MeasurePlane measure_plane(const Crs& crs, const Box& box, Warnings& warnings) {
    switch (crs.kind()) {
        case Crs::Kind::none:
            warnings.add("Nothing has a coordinate reference system; units are taken as metres.");
            return {};
        case Crs::Kind::geographic: {
            std::array<Position, 1> middle{box.centre()};
            CoordinateTransform(crs, Crs("EPSG:4326"), middle).apply(middle);
            return {Crs("+proj=tmerc +k=1 +lat_0=" + number_text(middle[0].y) +
                        " +lon_0=" + number_text(middle[0].x) + " +datum=WGS84 +units=m +type=crs"),
                    1, true};
        }
        case Crs::Kind::other:
            throw InputError("'" + crs.name() +
                             "' has no plane coordinates to measure in; reproject the reference first.");
        default:
            break;
    }
    const auto unit = crs.horizontal_unit();
    return {crs, unit ? unit->metres : 1, false};
}

void transform_to(const MeasurePlane& plane, const Crs& from, const std::string& name,
                  std::span<Polygons> areas, LongEdges long_edges, Warnings& warnings) {
    const Box box = box_of_all(areas);
    if (box.empty() || !needs_transformation(plane, from, name, warnings))
        return;
    const double longest = std::hypot(box.right - box.left, box.high - box.low) / parts_of_box;
    CoordinateTransform transform(from, plane.crs, corners(box));
    for (Polygons& area : areas)
        for_each_ring(area, [&](WorldRing& ring) {
            if (long_edges == LongEdges::divide)
                ring = densified(ring, longest);
            transform.apply(ring);
        });
}

Box box_of_all(std::span<const Polygons> areas) {
    Box box;
    for (const Polygons& area : areas)
        box.add(box_of(area));
    return box;
}

}  // namespace d2b::score
