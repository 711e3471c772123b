#define GEOS_USE_ONLY_R_API
#include "geometry/geos.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "dem2buildings/error.hpp"
#include "geometry/geos_handles.hpp"
#include "geometry/geos_interrupt.hpp"
#include "geometry/vast_polygons.hpp"

namespace d2b {
namespace {

struct FreeText {
    GEOSContextHandle_t context;
    void operator()(char* text) const { GEOSFree_r(context, text); }
};

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

/// What GEOS cannot even make a ring of, or null.
const char* wrong_points(const WorldRing& ring) {
    if (ring.empty())
        return "a ring has no points";
    for (const Position& p : ring)
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            return "a coordinate is not a finite number";
    return nullptr;
}

/// Twice the area, positive where the ring runs counter-clockwise; relative to its first point, so that large
/// coordinates do not drown it.
template <typename Point>
double signed_area(const std::vector<Point>& ring) {
    double sum = 0;
    const double x0 = x_of(ring.front());
    const double y0 = y_of(ring.front());
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum +=
            (x_of(ring[i]) - x0) * (y_of(ring[i + 1]) - y0) - (x_of(ring[i + 1]) - x0) * (y_of(ring[i]) - y0);
    return sum;
}

}  // namespace

struct Geos::Impl {
    ContextPtr context{GEOS_init_r()};
    std::string message;
    StopRequest stop;
    GeosInterrupt interrupt;

    explicit Impl(StopRequest the_stop) : stop(std::move(the_stop)) {
        GEOSContext_setErrorMessageHandler_r(context.get(), remember, this);
    }
    /// Called from C: nothing may be thrown.
    static void remember(const char* text, void* self) noexcept {
        try {
            static_cast<Impl*>(self)->message = text;
        } catch (const std::bad_alloc&) {
            static_cast<Impl*>(self)->message.clear();
        }
    }

    GeometryPtr own(GEOSGeometry* geometry) const {
        if (geometry == nullptr) {
            stop.check();
            throw GeometryError("GEOS failed on a polygon: " + message + ".");
        }
        return {geometry, GeometryDeleter{context.get()}};
    }

    template <typename Point>
    GeometryPtr ring(const std::vector<Point>& points) {
        const auto n = static_cast<unsigned>(points.size());
        GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context.get(), n + 1, 2);
        if (sequence == nullptr)
            throw GeometryError("GEOS failed on a ring: " + message + ".");
        for (unsigned i = 0; i <= n; ++i) {
            const Point& point = points[i % n];
            GEOSCoordSeq_setXY_r(context.get(), sequence, i, x_of(point), y_of(point));
        }
        return own(GEOSGeom_createLinearRing_r(context.get(), sequence));
    }

    static std::vector<GEOSGeometry*> release(std::vector<GeometryPtr>& geometries) {
        std::vector<GEOSGeometry*> given;
        given.reserve(geometries.size());
        for (GeometryPtr& geometry : geometries)
            given.push_back(geometry.release());
        return given;
    }

    template <typename Point>
    GeometryPtr polygon(const std::vector<Point>& exterior,
                        const std::vector<std::vector<Point>>& interiors) {
        GeometryPtr shell = ring(exterior);
        std::vector<GeometryPtr> holes;
        holes.reserve(interiors.size());
        for (const auto& interior : interiors) {
            stop.check();
            holes.push_back(ring(interior));
        }
        // GEOS owns what it is given, also where it fails.
        std::vector<GEOSGeometry*> given = release(holes);
        return own(GEOSGeom_createPolygon_r(context.get(), shell.release(), given.data(),
                                            static_cast<unsigned>(given.size())));
    }

    template <typename Polygon>
    GeometryPtr collection(const std::vector<Polygon>& polygons) {
        std::vector<GeometryPtr> parts;
        parts.reserve(polygons.size());
        for (const Polygon& p : polygons) {
            stop.check();
            parts.push_back(polygon(p.exterior, p.interiors));
        }
        std::vector<GEOSGeometry*> given = release(parts);
        return own(GEOSGeom_createCollection_r(context.get(), GEOS_MULTIPOLYGON, given.data(),
                                               static_cast<unsigned>(given.size())));
    }

    template <typename Point>
    std::vector<Point> points(const GEOSGeometry* ring, bool counter_clockwise) {
        const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context.get(), ring);
        unsigned n = 0;
        GEOSCoordSeq_getSize_r(context.get(), sequence, &n);
        std::vector<Point> result(n > 0 ? n - 1 : 0);
        for (unsigned i = 0; i + 1 < n; ++i) {
            double x = 0;
            double y = 0;
            GEOSCoordSeq_getXY_r(context.get(), sequence, i, &x, &y);
            set(result[i], x, y);
        }
        if (!result.empty() && (signed_area(result) > 0) != counter_clockwise)
            result = {result.rbegin(), result.rend()};
        return result;
    }

    /// As Geos::invalidity(), of finite polygons.
    std::string invalidity(const std::vector<WorldPolygon>& polygons) {
        GeometryPtr geometry;
        try {
            geometry = polygons.size() == 1 ? polygon(polygons.front().exterior, polygons.front().interiors)
                                            : collection(polygons);
        } catch (const GeometryError& error) {
            return error.what();
        }
        const char valid = GEOSisValid_r(context.get(), geometry.get());
        stop.check();
        if (valid == 1)
            return {};
        const std::unique_ptr<char, FreeText> reason(GEOSisValidReason_r(context.get(), geometry.get()),
                                                     FreeText{context.get()});
        stop.check();
        return reason ? reason.get() : "invalid";
    }

    std::string invalidity_of_vast(const WorldPolygon& polygon) {
        std::string reason = invalidity(inside_out(polygon));
        constexpr std::string_view nested = "Nested shells";
        if (reason.starts_with(nested))
            return "Hole lies outside shell or in another hole" + reason.substr(nested.size());
        if (!reason.empty())
            return reason;
        if (const std::optional<Position> parted = parted_at(polygon))
            return "Interior is disconnected[" + std::to_string(parted->x) + " " + std::to_string(parted->y) +
                   "]";
        return {};
    }

    /// Appends the polygons of a geometry of any type.
    template <typename Polygon>
    // NOLINTNEXTLINE(misc-no-recursion): GEOS makes no collections of collections but of multipolygons
    void collect(const GEOSGeometry* geometry, std::vector<Polygon>& polygons) {
        using Ring = decltype(Polygon::exterior);
        using Point = typename Ring::value_type;
        if (GEOSisEmpty_r(context.get(), geometry) == 1)
            return;
        if (GEOSGeomTypeId_r(context.get(), geometry) == GEOS_POLYGON) {
            Polygon polygon{points<Point>(GEOSGetExteriorRing_r(context.get(), geometry), true), {}};
            for (int i = 0; i < GEOSGetNumInteriorRings_r(context.get(), geometry); ++i)
                polygon.interiors.push_back(
                    points<Point>(GEOSGetInteriorRingN_r(context.get(), geometry, i), false));
            polygons.push_back(std::move(polygon));
        } else if (GEOSGeomTypeId_r(context.get(), geometry) >= GEOS_MULTIPOINT) {
            for (int i = 0; i < GEOSGetNumGeometries_r(context.get(), geometry); ++i)
                collect(GEOSGetGeometryN_r(context.get(), geometry, i), polygons);
        }
    }
};

Geos::Geos(StopRequest stop) : impl_(std::make_unique<Impl>(std::move(stop))) {}
Geos::Geos(Geos&&) noexcept = default;
Geos& Geos::operator=(Geos&&) noexcept = default;
Geos::~Geos() = default;

std::string Geos::invalidity(const std::vector<WorldPolygon>& polygons) {
    for (const WorldPolygon& polygon : polygons) {
        if (const char* wrong = wrong_points(polygon.exterior))
            return wrong;
        for (const WorldRing& ring : polygon.interiors)
            if (const char* wrong = wrong_points(ring))
                return wrong;
    }
    const GeosInterrupt::Watch watch(impl_->stop);
    if (std::ranges::none_of(polygons, is_vast))
        return impl_->invalidity(polygons);
    for (const WorldPolygon& polygon : polygons) {
        std::string reason =
            is_vast(polygon) ? impl_->invalidity_of_vast(polygon) : impl_->invalidity({polygon});
        if (!reason.empty())
            return reason;
    }
    return polygons.size() == 1 ? std::string() : impl_->invalidity(without_empty_holes(polygons));
}

std::vector<WorldPolygon> Geos::repaired(const std::vector<WorldPolygon>& polygons) {
    const GeosInterrupt::Watch watch(impl_->stop);
    GEOSContextHandle_t context = impl_->context.get();
    const GeometryPtr geometry = impl_->collection(polygons);
    GEOSMakeValidParams* params = GEOSMakeValidParams_create_r(context);
    GEOSMakeValidParams_setMethod_r(context, params, GEOS_MAKE_VALID_STRUCTURE);
    GEOSGeometry* made = GEOSMakeValidWithParams_r(context, geometry.get(), params);
    GEOSMakeValidParams_destroy_r(context, params);
    const GeometryPtr valid = impl_->own(made);
    std::vector<WorldPolygon> result;
    impl_->collect(valid.get(), result);
    return result;
}

std::vector<FinePolygon> Geos::difference(const FinePolygon& whole, const std::vector<FinePolygon>& parts) {
    if (parts.empty())
        return {whole};
    const GeosInterrupt::Watch watch(impl_->stop);
    GEOSContextHandle_t context = impl_->context.get();
    const GeometryPtr from = impl_->polygon(whole.exterior, whole.interiors);
    const GeometryPtr pieces = impl_->collection(parts);
    const GeometryPtr less = impl_->own(GEOSUnaryUnion_r(context, pieces.get()));
    const GeometryPtr left = impl_->own(GEOSDifference_r(context, from.get(), less.get()));
    std::vector<FinePolygon> result;
    impl_->collect(left.get(), result);
    return result;
}

double Geos::area_outside(const WorldPolygon& inner, const WorldPolygon& outer) {
    const GeosInterrupt::Watch watch(impl_->stop);
    GEOSContextHandle_t context = impl_->context.get();
    const GeometryPtr a = impl_->polygon(inner.exterior, inner.interiors);
    const GeometryPtr b = impl_->polygon(outer.exterior, outer.interiors);
    const GeometryPtr left = impl_->own(GEOSDifference_r(context, a.get(), b.get()));
    double area = 0;
    if (GEOSArea_r(context, left.get(), &area) == 0)
        throw GeometryError("GEOS failed to measure a polygon: " + impl_->message + ".");
    return area;
}

std::string geos_version() {
    const std::string text = GEOSversion();  // "3.11.1-CAPI-1.17.1"
    return text.substr(0, text.find('-'));
}

}  // namespace d2b
