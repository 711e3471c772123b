#define GEOS_USE_ONLY_R_API
#include "geometry/geos.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <utility>

#include <geos_c.h>

#include "dem2buildings/error.hpp"
#include "geometry/geos_converter.hpp"
#include "geometry/validity.hpp"

namespace d2b {

/// Enables interrupts of GEOS in this process during its lifetime. GEOS calls one global function without
/// parameters in its larger loops, for all threads. Its interrupt flag is global as well: the first thread to
/// see it clears it, whoever requested it. Therefore the flag is not used. Instead, the callback throws,
/// which aborts only the current thread's call, like an exception of GEOS itself.
class GeosInterrupt {
  public:
    GeosInterrupt();
    GeosInterrupt(const GeosInterrupt&) = delete;
    GeosInterrupt& operator=(const GeosInterrupt&) = delete;
    ~GeosInterrupt();

    /// Makes GEOS calls of this thread fail soon after a stop is requested; callers then have to check
    /// `stop`. Must not be nested.
    class Watch {
      public:
        explicit Watch(const StopToken& stop);
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;
        ~Watch();
    };
};

namespace {

// Globals are unavoidable, because GEOS passes no argument to its callback.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
thread_local const StopToken* current_stop = nullptr;
GEOSInterruptCallback* previous_callback = nullptr;  // previously registered callback
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void on_interrupt() {
    if (previous_callback != nullptr)
        previous_callback();
    if (current_stop != nullptr)
        current_stop->check();
}

struct Registrations {
    std::mutex mutex;
    int count = 0;
};

Registrations& registrations() {
    static Registrations all;
    return all;
}

double area_of(const GeosConverter& geos, const GeometryPtr& geometry) {
    double area = 0;
    if (GEOSArea_r(geos.context(), geometry.get(), &area) == 0)
        geos.fail("to measure a polygon");
    return area;
}

/// Area of the slivers between borders whose corners were rounded to doubles.
double area_of_rounding(const std::vector<WorldPolygon>& polygons) {
    constexpr double steps = 4 * std::numeric_limits<double>::epsilon();
    double length = 0;
    double largest = 0;
    for (const WorldPolygon& polygon : polygons)
        for (std::size_t i = 0; i < polygon.exterior.size(); ++i) {
            const Position& p = polygon.exterior[i];
            const Position& q = polygon.exterior[(i + 1) % polygon.exterior.size()];
            length += std::hypot(q.x - p.x, q.y - p.y);
            largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
        }
    return steps * largest * length;
}

}  // namespace

GeosInterrupt::GeosInterrupt() {
    Registrations& all = registrations();
    const std::lock_guard lock(all.mutex);
    if (all.count++ == 0)
        previous_callback = GEOS_interruptRegisterCallback(on_interrupt);
}

GeosInterrupt::~GeosInterrupt() {
    Registrations& all = registrations();
    const std::lock_guard lock(all.mutex);
    if (--all.count > 0)
        return;
    // Keep the callback of anyone who registered after us.
    if (GEOSInterruptCallback* last = GEOS_interruptRegisterCallback(previous_callback); last != on_interrupt)
        GEOS_interruptRegisterCallback(last);
}

GeosInterrupt::Watch::Watch(const StopToken& stop) {
    current_stop = &stop;
}

GeosInterrupt::Watch::~Watch() {
    current_stop = nullptr;
}

struct Geos::Impl {
    GeosConverter polygons;
    GeosInterrupt interrupt;

    explicit Impl(StopToken stop) : polygons(std::move(stop)) {}
};

Geos::Geos(StopToken stop) : impl_(std::make_unique<Impl>(std::move(stop))) {}
Geos::Geos(Geos&&) noexcept = default;
Geos& Geos::operator=(Geos&&) noexcept = default;
Geos::~Geos() = default;

std::string Geos::invalidity(const std::vector<WorldPolygon>& polygons) {
    const GeosInterrupt::Watch watch(impl_->polygons.stop());
    return d2b::invalidity(impl_->polygons, polygons);
}

std::vector<WorldPolygon> Geos::repaired(const std::vector<WorldPolygon>& polygons) {
    const GeosInterrupt::Watch watch(impl_->polygons.stop());
    return d2b::repaired(impl_->polygons, polygons);
}

std::vector<WorldPolygon> Geos::snap_to_grid(const std::vector<WorldPolygon>& polygons, double step) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr exact = geos.multi_polygon(polygons);
    const GeometryPtr snapped = geos.wrap(GEOSGeom_setPrecision_r(geos.context(), exact.get(), step, 0));
    return geos.polygons_of<WorldPolygon>(snapped.get());
}

bool Geos::overlap(const std::vector<WorldPolygon>& one, const std::vector<WorldPolygon>& other) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr a = geos.multi_polygon(one);
    const GeometryPtr b = geos.multi_polygon(other);
    return geos.predicate(GEOSRelatePattern_r(geos.context(), a.get(), b.get(), "T********")) &&
           area_of(geos, geos.wrap(GEOSIntersection_r(geos.context(), a.get(), b.get()))) >
               area_of_rounding(one);
}

std::vector<FinePolygon> Geos::difference(const FinePolygon& whole, const std::vector<FinePolygon>& parts) {
    if (parts.empty())
        return {whole};
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr from = geos.polygon(whole);
    const GeometryPtr pieces = geos.multi_polygon(parts);
    const GeometryPtr less = geos.wrap(GEOSUnaryUnion_r(geos.context(), pieces.get()));
    const GeometryPtr left = geos.wrap(GEOSDifference_r(geos.context(), from.get(), less.get()));
    return geos.polygons_of<FinePolygon>(left.get());
}

std::vector<FinePolygon> Geos::divide(const FinePolygon& whole, const std::vector<FineSegment>& lines) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr area = geos.polygon(whole);
    const GeometryPtr given = geos.multi_line(lines);
    const GeometryPtr boundary = geos.wrap(GEOSBoundary_r(geos.context(), area.get()));
    const GeometryPtr net = geos.wrap(GEOSUnionPrec_r(geos.context(), boundary.get(), given.get(), 1));
    const GEOSGeometry* const noded = net.get();
    const GeometryPtr faces = geos.wrap(GEOSPolygonize_r(geos.context(), &noded, 1));
    const PreparedPtr prepared(GEOSPrepare_r(geos.context(), area.get()), {geos.context()});
    if (!prepared)
        geos.fail("to prepare a polygon");
    std::vector<FinePolygon> inside;
    for (FinePolygon& face : geos.polygons_of<FinePolygon>(faces.get())) {
        const GeometryPtr polygon = geos.polygon(face);
        const GeometryPtr point = geos.wrap(GEOSPointOnSurface_r(geos.context(), polygon.get()));
        if (geos.predicate(GEOSPreparedContains_r(geos.context(), prepared.get(), point.get())))
            inside.push_back(std::move(face));
    }
    return inside;
}

std::vector<FinePolygon> Geos::polygonize(const std::vector<FineSegment>& edges) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr lines = geos.multi_line(edges);
    const GEOSGeometry* const noded = lines.get();
    const GeometryPtr faces = geos.wrap(GEOSPolygonize_r(geos.context(), &noded, 1));
    return geos.polygons_of<FinePolygon>(faces.get());
}

std::vector<std::array<FinePoint, 3>> Geos::triangles(const FinePolygon& polygon) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr whole = geos.polygon(polygon);
    const GeometryPtr parts = geos.wrap(GEOSConstrainedDelaunayTriangulation_r(geos.context(), whole.get()));
    std::vector<std::array<FinePoint, 3>> triangles;
    for (const FinePolygon& part : geos.polygons_of<FinePolygon>(parts.get())) {
        if (part.exterior.size() != 3)
            throw GeometryError("GEOS divided a polygon into a piece that is not a triangle.");
        triangles.push_back({part.exterior[0], part.exterior[1], part.exterior[2]});
    }
    return triangles;
}

double Geos::area_outside(const WorldPolygon& inner, const WorldPolygon& outer) {
    const GeosConverter& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr a = geos.polygon(inner);
    const GeometryPtr b = geos.polygon(outer);
    return area_of(geos, geos.wrap(GEOSDifference_r(geos.context(), a.get(), b.get())));
}

std::string geos_version() {
    const std::string text = GEOSversion();  // "3.11.1-CAPI-1.17.1"
    return text.substr(0, text.find('-'));
}

}  // namespace d2b
