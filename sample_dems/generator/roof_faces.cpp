#include "roof_faces.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <ogr_geometry.h>

#include "gdal_guard.hpp"

namespace d2b::sample {

namespace {

constexpr double level_below = 8;  // degrees
/// Square metres: far above the slivers that rounding leaves between pieces, far below any face.
constexpr double least_area = 1e-6;
constexpr double rounding = 1e-9;   // metres
constexpr double longest_peak = 1;  // metres: a shorter ridge is the peak of a pyramid

/// z = a x + b y + c in a building's frame.
struct Plane {
    double a = 0;
    double b = 0;
    double c = 0;

    [[nodiscard]] double at(const Position& p) const { return a * p.x + b * p.y + c; }
    [[nodiscard]] Plane minus(const Plane& other) const { return {a - other.a, b - other.b, c - other.c}; }
    [[nodiscard]] bool is_zero() const {
        return std::abs(a) < rounding && std::abs(b) < rounding && std::abs(c) < rounding;
    }
};

/// Planes whose lowest one at a point is the share of the rise there, where x runs along the ridge from 0 to
/// `length`, and y across it from 0 to `span`.
std::vector<Plane> shares_of_rise(Roof roof, double length, double span) {
    const double slope = 2 / span;
    const std::vector<Plane> sides{{0, slope, 0}, {0, -slope, 2}};
    std::vector<Plane> hips = sides;
    hips.push_back({slope, 0, 0});
    hips.push_back({-slope, 0, slope * length});
    switch (roof) {
        case Roof::flat:
            return {{}};
        case Roof::shed:
            return {{0, 1 / span, 0}};
        case Roof::gabled:
            return sides;
        case Roof::hipped:
            return hips;
        case Roof::mansard: {
            const double steep = mansard_rise / mansard_way;
            const double gentle = (1 - mansard_rise) / (1 - mansard_way);
            std::vector<Plane> all;
            for (const Plane& hip : hips) {
                all.push_back({steep * hip.a, steep * hip.b, steep * hip.c});
                all.push_back(
                    {gentle * hip.a, gentle * hip.b, gentle * hip.c + mansard_rise - gentle * mansard_way});
            }
            return all;
        }
        case Roof::cone:
        case Roof::dome:
            break;
    }
    return {};
}

/// Planes whose lowest one at a point of the part's rectangle is the height of its roof.
std::vector<Plane> planes_of(const RoofPart& part) {
    const Rect& rect = part.rect;
    const double rise = part.top - part.eave;
    std::vector<Plane> planes = part.ridge_along_x ? shares_of_rise(part.roof, rect.width(), rect.depth())
                                                   : shares_of_rise(part.roof, rect.depth(), rect.width());
    for (Plane& plane : planes) {
        if (!part.ridge_along_x)
            std::swap(plane.a, plane.b);
        plane = {rise * plane.a, rise * plane.b, part.eave + rise * plane.c};
        plane.c -= plane.a * rect.x0 + plane.b * rect.y0;
    }
    return planes;
}

/// Returns the part of a convex ring where a plane is not negative.
WorldRing clipped(const WorldRing& ring, const Plane& side) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i];
        const Position& q = ring[(i + 1) % ring.size()];
        const double at_p = side.at(p);
        const double at_q = side.at(q);
        if (at_p >= 0)
            result.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
            const double t = at_p / (at_p - at_q);
            result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
        }
    }
    return result;
}

WorldRing ring_of(const Rect& r) {
    return {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}};
}

void add_ring(OGRPolygon& polygon, const WorldRing& ring) {
    OGRLinearRing line;
    for (const Position& p : ring)
        line.addPoint(p.x, p.y);
    line.closeRings();
    polygon.addRing(&line);
}

OGRPolygon polygon_of(const WorldRing& ring) {
    OGRPolygon polygon;
    add_ring(polygon, ring);
    return polygon;
}

/// The polygons of a geometry that are larger than rounding errors.
OGRMultiPolygon polygons_of(const OGRGeometry& geometry) {
    OGRMultiPolygon all;
    const auto add = [&](const OGRGeometry& part) {
        if (wkbFlatten(part.getGeometryType()) == wkbPolygon && part.toPolygon()->get_Area() > least_area)
            all.addGeometry(&part);
    };
    if (OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection) == 0)
        add(geometry);
    else
        for (const OGRGeometry* part : *geometry.toGeometryCollection())
            add(*part);
    return all;
}

OGRMultiPolygon polygons_of(const std::unique_ptr<OGRGeometry>& geometry, const Building& building) {
    QuietGdal::require(geometry != nullptr, "the roof of building " + std::to_string(building.id));
    return polygons_of(*geometry);
}

struct PartPlanes {
    Rect rect;
    std::vector<Plane> planes;
};

/// The area in which a part stands higher than a plane. Where both are one plane, the first of two parts is
/// taken to be the higher one.
WorldRing higher_than(const Plane& plane, const PartPlanes& part, bool first) {
    WorldRing ring = ring_of(part.rect);
    for (const Plane& other : part.planes) {
        const Plane above = other.minus(plane);
        if (!above.is_zero())
            ring = clipped(ring, above);
        else if (!first)
            return {};
    }
    return ring;
}

/// One plane and all that is seen of it.
struct SeenPlane {
    Plane plane;
    OGRMultiPolygon seen;
};

OGRMultiPolygon seen_of(const std::vector<PartPlanes>& parts, std::size_t own, const Plane& plane,
                        const Building& building) {
    WorldRing ring = ring_of(parts[own].rect);
    for (const Plane& other : parts[own].planes)
        if (const Plane above = other.minus(plane); !above.is_zero())
            ring = clipped(ring, above);
    if (ring.size() < 3)
        return {};
    OGRMultiPolygon seen = polygons_of(polygon_of(ring));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i == own)
            continue;
        const WorldRing hidden = higher_than(plane, parts[i], i < own);
        if (hidden.size() < 3)
            continue;
        const OGRPolygon hider = polygon_of(hidden);
        if (seen.Intersects(&hider))
            seen = polygons_of(std::unique_ptr<OGRGeometry>(seen.Difference(&hider)), building);
    }
    return seen;
}

void add(std::vector<SeenPlane>& all, const Plane& plane, OGRMultiPolygon seen, const Building& building) {
    if (seen.IsEmpty())
        return;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const SeenPlane& one) { return one.plane.minus(plane).is_zero(); });
    if (same == all.end())
        all.push_back({plane, std::move(seen)});
    else
        same->seen = polygons_of(std::unique_ptr<OGRGeometry>(same->seen.Union(&seen)), building);
}

/// The corners of a ring, none of which repeats the last one.
WorldRing corners_of(const OGRLinearRing& line) {
    WorldRing ring;
    for (int i = 1; i < line.getNumPoints(); ++i)
        if (const Position p{line.getX(i), line.getY(i)};
            distance(p, {line.getX(i - 1), line.getY(i - 1)}) > rounding)
            ring.push_back(p);
    return ring;
}

/// A ring with those of the given points as corners that its edges pass through but for rounding errors.
WorldRing with_corners(const WorldRing& ring, const WorldRing& points) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        WorldRing on_edge;
        for (const Position& p : points)
            if (distance(a, p) > rounding && distance(b, p) > rounding &&
                distance_to_segment(a, b, p) < rounding)
                on_edge.push_back(p);
        std::sort(on_edge.begin(), on_edge.end(),
                  [&a](const Position& p, const Position& q) { return distance(a, p) < distance(a, q); });
        result.push_back(a);
        result.insert(result.end(), on_edge.begin(), on_edge.end());
    }
    return result;
}

/// A piece of a plane, divided where it touches itself in a point: where ridges of one height meet, rounding
/// leaves a bridge of no width.
OGRMultiPolygon divided(const OGRPolygon& polygon, const Building& building) {
    std::vector<WorldRing> rings{corners_of(*polygon.getExteriorRing())};
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
        rings.push_back(corners_of(*polygon.getInteriorRing(i)));
    WorldRing points;
    for (WorldRing& ring : rings)
        for (Position& corner : ring) {
            const auto same = std::find_if(points.begin(), points.end(), [&](const Position& p) {
                return distance(p, corner) <= rounding;
            });
            if (same == points.end())
                points.push_back(corner);
            else
                corner = *same;
        }
    OGRPolygon noded;
    for (const WorldRing& ring : rings)
        add_ring(noded, with_corners(ring, points));
    return noded.IsValid() != 0 ? polygons_of(noded)
                                : polygons_of(std::unique_ptr<OGRGeometry>(noded.MakeValid()), building);
}

/// Ring without corners on straight lines, from the leftmost lowest corner on, in the given direction:
/// the same for each GEOS.
WorldRing tidy(const OGRLinearRing& line, bool clockwise) {
    WorldRing ring = corners_of(line);
    if ((line.isClockwise() != 0) != clockwise)
        std::reverse(ring.begin(), ring.end());
    WorldRing corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& before = ring[(i + ring.size() - 1) % ring.size()];
        const Position& after = ring[(i + 1) % ring.size()];
        if (std::abs(left_of(before, after, ring[i])) > rounding)
            corners.push_back(ring[i]);
    }
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end(),
                                 [](const Position& p, const Position& q) {
                                     return std::pair(p.y, p.x) < std::pair(q.y, q.x);
                                 }),
                corners.end());
    return corners;
}

std::vector<RoofCorner> lifted(const WorldRing& ring, const Plane& plane, const Building& building) {
    std::vector<RoofCorner> corners;
    corners.reserve(ring.size());
    for (const Position& p : ring)
        corners.push_back({building.frame.to_scene(p), building.ground + plane.at(p)});
    return corners;
}

/// Rounds to a millionth of a degree, because the last bits of arc tangents differ between C libraries.
double degrees(double radians) {
    return std::round(radians * 180 / std::numbers::pi * 1e6) / 1e6;
}

RoofFace face_of(const OGRPolygon& polygon, const Plane& plane, const Building& building) {
    RoofFace face;
    face.rings.push_back(lifted(tidy(*polygon.getExteriorRing(), false), plane, building));
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
        face.rings.push_back(lifted(tidy(*polygon.getInteriorRing(i), true), plane, building));
    face.slope = degrees(std::atan(std::sqrt(plane.a * plane.a + plane.b * plane.b)));
    if (face.slope >= level_below) {
        const Direction& axis = building.frame.x_axis;
        const double east = axis.cosine * plane.a - axis.sine * plane.b;
        const double north = axis.sine * plane.a + axis.cosine * plane.b;
        const double azimuth = degrees(std::atan2(-east, -north));
        face.azimuth = azimuth < 0 ? azimuth + 360 : azimuth;
    }
    return face;
}

/// The footprint as a level face: its walls need not follow the part's rectangle.
RoofFace level_face(const Building& building) {
    RoofFace face;
    const auto add = [&](const WorldRing& ring) {
        std::vector<RoofCorner>& corners = face.rings.emplace_back();
        for (const Position& p : ring)
            corners.push_back({p, building.ground + building.parts.front().eave});
    };
    add(building.footprint.exterior);
    for (const WorldRing& hole : building.footprint.interiors)
        add(hole);
    return face;
}

}  // namespace

std::vector<RoofFace> roof_faces(const Building& building) {
    if (building.parts.size() == 1 && building.parts.front().roof == Roof::flat)
        return {level_face(building)};
    const QuietGdal quiet;
    std::vector<PartPlanes> parts;
    for (const RoofPart& part : building.parts) {
        if (part.roof == Roof::cone || part.roof == Roof::dome)
            return {};
        parts.push_back({part.rect, planes_of(part)});
    }
    std::vector<SeenPlane> all;
    for (std::size_t own = 0; own < parts.size(); ++own)
        for (const Plane& plane : parts[own].planes)
            add(all, plane, seen_of(parts, own, plane, building), building);
    std::vector<RoofFace> faces;
    for (const SeenPlane& one : all) {
        std::vector<RoofFace> pieces;
        for (const OGRPolygon* polygon : one.seen)
            for (const OGRPolygon* piece : divided(*polygon, building))
                pieces.push_back(face_of(*piece, one.plane, building));
        // Their order is that of GEOS.
        std::sort(pieces.begin(), pieces.end(), [](const RoofFace& a, const RoofFace& b) {
            const Position& p = a.rings.front().front().at;
            const Position& q = b.rings.front().front().at;
            return std::pair(p.y, p.x) < std::pair(q.y, q.x);
        });
        std::move(pieces.begin(), pieces.end(), std::back_inserter(faces));
    }
    return faces;
}

std::string_view roof_type(const Building& building) {
    const RoofPart& part = building.main_part();
    switch (part.roof) {
        case Roof::cone:
        case Roof::dome:
            return "domed";
        case Roof::hipped:
            return std::abs(part.rect.width() - part.rect.depth()) <= longest_peak ? "pyramidal" : "hipped";
        default:
            return roof_name(part.roof);
    }
}

}  // namespace d2b::sample
