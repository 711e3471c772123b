#include "score/measure_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "geometry/box.hpp"

namespace d2b {
namespace {

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
bool differs(const MeasurePlane& plane, const Crs& from, const std::string& name, Warnings& warnings) {
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

WorldRing with_more_vertices(const WorldRing& ring, double longest) {
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

void bring_to(const MeasurePlane& plane, const Crs& from, const std::string& name, std::span<Polygons> areas,
              LongEdges long_edges, Warnings& warnings) {
    const Box box = box_of_all(areas);
    if (box.empty() || !differs(plane, from, name, warnings))
        return;
    const double longest = std::hypot(box.right - box.left, box.high - box.low) / parts_of_box;
    CoordinateTransform transform(from, plane.crs, corners(box));
    for (Polygons& area : areas)
        for_each_ring(area, [&](WorldRing& ring) {
            if (long_edges == LongEdges::divide)
                ring = with_more_vertices(ring, longest);
            transform.apply(ring);
        });
}

Box box_of_all(std::span<const Polygons> areas) {
    Box box;
    for (const Polygons& area : areas)
        box.add(box_of(area));
    return box;
}

}  // namespace d2b
