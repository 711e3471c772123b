#define GEOS_USE_ONLY_R_API
#include "geometry/geos_polygons.hpp"

#include <new>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Called from C: nothing may be thrown.
void remember(const char* text, void* message) noexcept {
    try {
        *static_cast<std::string*>(message) = text;
    } catch (const std::bad_alloc&) {
        static_cast<std::string*>(message)->clear();
    }
}

/// Counter-clockwise or clockwise; relative to the first position, so that large coordinates do not drown it.
bool runs_counter_clockwise(const WorldRing& ring) {
    double twice_area = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        twice_area += (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) -
                      (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
    return twice_area > 0;
}

WorldRing oriented(WorldRing ring, bool counter_clockwise) {
    if (!ring.empty())
        ring.pop_back();
    if (runs_counter_clockwise(ring) != counter_clockwise)
        return {ring.rbegin(), ring.rend()};
    return ring;
}

/// Calls `visit` with every geometry in it that is no collection.
template <typename Visit>
// NOLINTNEXTLINE(misc-no-recursion): GEOS makes no collections of collections but of multipolygons
void for_each_part(GEOSContextHandle_t context, const GEOSGeometry* geometry, const Visit& visit) {
    if (GEOSisEmpty_r(context, geometry) == 1)
        return;
    if (GEOSGeomTypeId_r(context, geometry) < GEOS_MULTIPOINT)
        return visit(geometry);
    for (int i = 0; i < GEOSGetNumGeometries_r(context, geometry); ++i)
        for_each_part(context, GEOSGetGeometryN_r(context, geometry, i), visit);
}

}  // namespace

GeosPolygons::GeosPolygons() : context_(GEOS_init_r()) {
    GEOSContext_setErrorMessageHandler_r(context_.get(), remember, &message_);
}

GeometryPtr GeosPolygons::own(GEOSGeometry* geometry) const {
    if (geometry == nullptr)
        throw GeometryError("GEOS failed on polygons: " + message_ + ".");
    return {geometry, GeometryDeleter{context()}};
}

bool GeosPolygons::answer(char value) const {
    constexpr char failed = 2;
    if (value == failed)
        throw GeometryError("GEOS failed to compare polygons: " + message_ + ".");
    return value == 1;
}

GeometryPtr GeosPolygons::ring(const WorldRing& points) const {
    const auto n = static_cast<unsigned>(points.size());
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context(), n + 1, 2);
    if (sequence == nullptr)
        throw GeometryError("GEOS failed on a ring: " + message_ + ".");
    for (unsigned i = 0; i <= n; ++i)
        GEOSCoordSeq_setXY_r(context(), sequence, i, points[i % n].x, points[i % n].y);
    return own(GEOSGeom_createLinearRing_r(context(), sequence));
}

GeometryPtr GeosPolygons::polygon(const WorldPolygon& polygon) const {
    GeometryPtr shell = ring(polygon.exterior);
    std::vector<GeometryPtr> holes;
    for (const WorldRing& interior : polygon.interiors)
        holes.push_back(ring(interior));
    // GEOS owns what it is given, also where it fails.
    std::vector<GEOSGeometry*> given;
    given.reserve(holes.size());
    for (GeometryPtr& hole : holes)
        given.push_back(hole.release());
    return own(GEOSGeom_createPolygon_r(context(), shell.release(), given.data(),
                                        static_cast<unsigned>(given.size())));
}

GeometryPtr GeosPolygons::collection(int type, std::vector<GeometryPtr> parts) const {
    std::vector<GEOSGeometry*> given;
    given.reserve(parts.size());
    for (GeometryPtr& part : parts)
        given.push_back(part.release());
    return own(
        GEOSGeom_createCollection_r(context(), type, given.data(), static_cast<unsigned>(given.size())));
}

GeometryPtr GeosPolygons::multi_polygon(std::span<const WorldPolygon> polygons) const {
    std::vector<GeometryPtr> parts;
    parts.reserve(polygons.size());
    for (const WorldPolygon& part : polygons)
        parts.push_back(polygon(part));
    return collection(GEOS_MULTIPOLYGON, std::move(parts));
}

GeometryPtr GeosPolygons::multi_line(std::span<const WorldPolygon> polygons) const {
    std::vector<GeometryPtr> parts;
    for (const WorldPolygon& polygon : polygons) {
        parts.push_back(ring(polygon.exterior));
        for (const WorldRing& interior : polygon.interiors)
            parts.push_back(ring(interior));
    }
    return collection(GEOS_MULTILINESTRING, std::move(parts));
}

std::vector<Position> GeosPolygons::positions(const GEOSGeometry* line) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context(), line);
    unsigned n = 0;
    GEOSCoordSeq_getSize_r(context(), sequence, &n);
    std::vector<Position> result(n);
    for (unsigned i = 0; i < n; ++i)
        GEOSCoordSeq_getXY_r(context(), sequence, i, &result[i].x, &result[i].y);
    return result;
}

std::vector<WorldPolygon> GeosPolygons::polygons_of(const GEOSGeometry* geometry) const {
    std::vector<WorldPolygon> result;
    for_each_part(context(), geometry, [&](const GEOSGeometry* part) {
        if (GEOSGeomTypeId_r(context(), part) != GEOS_POLYGON)
            return;
        WorldPolygon polygon{oriented(positions(GEOSGetExteriorRing_r(context(), part)), true), {}};
        for (int i = 0; i < GEOSGetNumInteriorRings_r(context(), part); ++i)
            polygon.interiors.push_back(
                oriented(positions(GEOSGetInteriorRingN_r(context(), part, i)), false));
        result.push_back(std::move(polygon));
    });
    return result;
}

std::vector<std::vector<Position>> GeosPolygons::lines_of(const GEOSGeometry* geometry) const {
    std::vector<std::vector<Position>> result;
    for_each_part(context(), geometry, [&](const GEOSGeometry* part) {
        const int type = GEOSGeomTypeId_r(context(), part);
        if (type == GEOS_LINESTRING || type == GEOS_LINEARRING)
            result.push_back(positions(part));
    });
    return result;
}

}  // namespace d2b
