#define GEOS_USE_ONLY_R_API
#include "geometry/geos_converter.hpp"

#include <cmath>
#include <new>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Error handler called from C, so it must not throw.
void store_message(const char* text, void* message) noexcept {
    try {
        *static_cast<std::string*>(message) = text;
    } catch (const std::bad_alloc&) {
        static_cast<std::string*>(message)->clear();
    }
}

double x_of(const Position& p) {
    return p.x;
}
double y_of(const Position& p) {
    return p.y;
}
double x_of(FinePoint p) {
    return static_cast<double>(p.col);
}
double y_of(FinePoint p) {
    return -static_cast<double>(p.row);
}
void set(Position& p, double x, double y) {
    p = {x, y};
}
void set(FinePoint& p, double x, double y) {
    if (x != std::round(x) || y != std::round(y))
        throw GeometryError(
            "GEOS moved a vertex off the lattice, which outlines that share whole edges rule out.");
    p = {static_cast<std::int64_t>(-y), static_cast<std::int64_t>(x)};
}

/// Relative to the first point, because large coordinates would cancel the area.
template <typename Point>
bool runs_counter_clockwise(const std::vector<Point>& ring) {
    double twice_area = 0;
    const double x0 = x_of(ring.front());
    const double y0 = y_of(ring.front());
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        twice_area +=
            (x_of(ring[i]) - x0) * (y_of(ring[i + 1]) - y0) - (x_of(ring[i + 1]) - x0) * (y_of(ring[i]) - y0);
    return twice_area > 0;
}

/// @param ring with repeated first point
template <typename Point>
std::vector<Point> oriented(std::vector<Point> ring, bool counter_clockwise) {
    if (!ring.empty())
        ring.pop_back();
    if (!ring.empty() && runs_counter_clockwise(ring) != counter_clockwise)
        return {ring.rbegin(), ring.rend()};
    return ring;
}

std::vector<GEOSGeometry*> release(std::vector<GeometryPtr>& geometries) {
    std::vector<GEOSGeometry*> given;
    given.reserve(geometries.size());
    for (GeometryPtr& geometry : geometries)
        given.push_back(geometry.release());
    return given;
}

/// Calls `visit` with every non-collection geometry in it.
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

GeosConverter::GeosConverter(StopToken stop) : stop_(std::move(stop)), context_(GEOS_init_r()) {
    GEOSContext_setErrorMessageHandler_r(context_.get(), store_message, &message_);
}

GeometryPtr GeosConverter::wrap(GEOSGeometry* geometry) const {
    if (geometry == nullptr)
        fail("on a polygon");
    return {geometry, GeometryDeleter{context()}};
}

bool GeosConverter::predicate(char value) const {
    constexpr char failed = 2;
    if (value == failed)
        fail("to compare polygons");
    return value == 1;
}

void GeosConverter::fail(const char* what) const {
    stop_.check();
    throw GeometryError(std::string("GEOS failed ") + what + ": " + message_ + ".");
}

template <typename Point>
GeometryPtr GeosConverter::ring(const std::vector<Point>& points) const {
    stop_.check();
    const auto n = static_cast<unsigned>(points.size());
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context(), n + 1, 2);
    if (sequence == nullptr)
        fail("on a ring");
    for (unsigned i = 0; i <= n; ++i) {
        const Point& point = points[i % n];
        GEOSCoordSeq_setXY_r(context(), sequence, i, x_of(point), y_of(point));
    }
    return wrap(GEOSGeom_createLinearRing_r(context(), sequence));
}

template <typename Polygon>
GeometryPtr GeosConverter::polygon(const Polygon& polygon) const {
    GeometryPtr shell = ring(polygon.exterior);
    std::vector<GeometryPtr> holes;
    holes.reserve(polygon.interiors.size());
    for (const auto& interior : polygon.interiors)
        holes.push_back(ring(interior));
    // GEOS takes ownership of its arguments even if it fails.
    std::vector<GEOSGeometry*> given = release(holes);
    return wrap(GEOSGeom_createPolygon_r(context(), shell.release(), given.data(),
                                         static_cast<unsigned>(given.size())));
}

GeometryPtr GeosConverter::collection(int type, std::vector<GeometryPtr> parts) const {
    std::vector<GEOSGeometry*> given = release(parts);
    return wrap(
        GEOSGeom_createCollection_r(context(), type, given.data(), static_cast<unsigned>(given.size())));
}

template <typename List>
GeometryPtr GeosConverter::multi_polygon(const List& polygons) const {
    std::vector<GeometryPtr> parts;
    parts.reserve(polygons.size());
    for (const auto& part : polygons)
        parts.push_back(polygon(part));
    return collection(GEOS_MULTIPOLYGON, std::move(parts));
}

GeometryPtr GeosConverter::line_ring(const WorldRing& points) const {
    return ring(points);
}

GeometryPtr GeosConverter::multi_line(std::span<const WorldPolygon> polygons) const {
    std::vector<GeometryPtr> parts;
    for (const WorldPolygon& polygon : polygons) {
        parts.push_back(ring(polygon.exterior));
        for (const WorldRing& interior : polygon.interiors)
            parts.push_back(ring(interior));
    }
    return collection(GEOS_MULTILINESTRING, std::move(parts));
}

GeometryPtr GeosConverter::multi_line(std::span<const FineSegment> segments) const {
    std::vector<GeometryPtr> parts;
    parts.reserve(segments.size());
    for (const FineSegment& segment : segments) {
        GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context(), 2, 2);
        if (sequence == nullptr)
            fail("on a line");
        GEOSCoordSeq_setXY_r(context(), sequence, 0, x_of(segment.from), y_of(segment.from));
        GEOSCoordSeq_setXY_r(context(), sequence, 1, x_of(segment.to), y_of(segment.to));
        parts.push_back(wrap(GEOSGeom_createLineString_r(context(), sequence)));
    }
    return collection(GEOS_MULTILINESTRING, std::move(parts));
}

template <typename Point>
std::vector<Point> GeosConverter::points_of(const GEOSGeometry* line) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context(), line);
    unsigned n = 0;
    GEOSCoordSeq_getSize_r(context(), sequence, &n);
    std::vector<Point> result(n);
    for (unsigned i = 0; i < n; ++i) {
        double x = 0;
        double y = 0;
        GEOSCoordSeq_getXY_r(context(), sequence, i, &x, &y);
        set(result[i], x, y);
    }
    return result;
}

template <typename Polygon>
std::vector<Polygon> GeosConverter::polygons_of(const GEOSGeometry* geometry) const {
    using Point = typename decltype(Polygon::exterior)::value_type;
    std::vector<Polygon> result;
    for_each_part(context(), geometry, [&](const GEOSGeometry* part) {
        if (GEOSGeomTypeId_r(context(), part) != GEOS_POLYGON)
            return;
        Polygon polygon{oriented(points_of<Point>(GEOSGetExteriorRing_r(context(), part)), true), {}};
        for (int i = 0; i < GEOSGetNumInteriorRings_r(context(), part); ++i)
            polygon.interiors.push_back(
                oriented(points_of<Point>(GEOSGetInteriorRingN_r(context(), part, i)), false));
        result.push_back(std::move(polygon));
    });
    return result;
}

std::vector<std::vector<Position>> GeosConverter::lines_of(const GEOSGeometry* geometry) const {
    std::vector<std::vector<Position>> result;
    for_each_part(context(), geometry, [&](const GEOSGeometry* part) {
        const int type = GEOSGeomTypeId_r(context(), part);
        if (type == GEOS_LINESTRING || type == GEOS_LINEARRING)
            result.push_back(points_of<Position>(part));
    });
    return result;
}

template GeometryPtr GeosConverter::polygon(const WorldPolygon&) const;
template GeometryPtr GeosConverter::polygon(const FinePolygon&) const;
template GeometryPtr GeosConverter::multi_polygon(const std::span<const WorldPolygon>&) const;
template GeometryPtr GeosConverter::multi_polygon(const std::vector<WorldPolygon>&) const;
template GeometryPtr GeosConverter::multi_polygon(const std::vector<FinePolygon>&) const;
template std::vector<WorldPolygon> GeosConverter::polygons_of(const GEOSGeometry*) const;
template std::vector<FinePolygon> GeosConverter::polygons_of(const GEOSGeometry*) const;

}  // namespace d2b
