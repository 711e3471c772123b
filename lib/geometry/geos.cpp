#define GEOS_USE_ONLY_R_API
#include "geometry/geos.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dem2buildings/error.hpp"
#include "geometry/geos_interrupt.hpp"
#include "geometry/geos_polygons.hpp"
#include "geometry/validity.hpp"

namespace d2b {

namespace {

double area_of(const GeosPolygons& geos, const GeometryPtr& geometry) {
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

struct Geos::Impl {
    GeosPolygons polygons;
    GeosInterrupt interrupt;

    explicit Impl(StopRequest stop) : polygons(std::move(stop)) {}
};

Geos::Geos(StopRequest stop) : impl_(std::make_unique<Impl>(std::move(stop))) {}
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

std::vector<WorldPolygon> Geos::on_grid(const std::vector<WorldPolygon>& polygons, double step) {
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr exact = geos.multi_polygon(polygons);
    const GeometryPtr snapped = geos.own(GEOSGeom_setPrecision_r(geos.context(), exact.get(), step, 0));
    return geos.polygons_of<WorldPolygon>(snapped.get());
}

std::vector<bool> Geos::covered(const std::vector<WorldPolygon>& outer,
                                const std::vector<std::vector<WorldPolygon>>& inner) {
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr whole = geos.multi_polygon(outer);
    const PreparedPtr prepared(GEOSPrepare_r(geos.context(), whole.get()), {geos.context()});
    if (!prepared)
        geos.fail("to prepare a polygon");
    std::vector<bool> answers;
    for (const std::vector<WorldPolygon>& part : inner) {
        geos.stop().check();
        const GeometryPtr geometry = geos.multi_polygon(part);
        const bool exactly =
            geos.answer(GEOSPreparedCovers_r(geos.context(), prepared.get(), geometry.get()));
        answers.push_back(exactly ||
                          area_of(geos, geos.own(GEOSDifference_r(geos.context(), geometry.get(),
                                                                  whole.get()))) <= area_of_rounding(part));
    }
    return answers;
}

bool Geos::overlap(const std::vector<WorldPolygon>& one, const std::vector<WorldPolygon>& other) {
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr a = geos.multi_polygon(one);
    const GeometryPtr b = geos.multi_polygon(other);
    return geos.answer(GEOSRelatePattern_r(geos.context(), a.get(), b.get(), "T********")) &&
           area_of(geos, geos.own(GEOSIntersection_r(geos.context(), a.get(), b.get()))) >
               area_of_rounding(one);
}

std::vector<FinePolygon> Geos::difference(const FinePolygon& whole, const std::vector<FinePolygon>& parts) {
    if (parts.empty())
        return {whole};
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr from = geos.polygon(whole);
    const GeometryPtr pieces = geos.multi_polygon(parts);
    const GeometryPtr less = geos.own(GEOSUnaryUnion_r(geos.context(), pieces.get()));
    const GeometryPtr left = geos.own(GEOSDifference_r(geos.context(), from.get(), less.get()));
    return geos.polygons_of<FinePolygon>(left.get());
}

std::vector<std::array<FinePoint, 3>> Geos::triangles(const FinePolygon& polygon) {
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr whole = geos.polygon(polygon);
    const GeometryPtr parts = geos.own(GEOSConstrainedDelaunayTriangulation_r(geos.context(), whole.get()));
    std::vector<std::array<FinePoint, 3>> triangles;
    for (const FinePolygon& part : geos.polygons_of<FinePolygon>(parts.get())) {
        if (part.exterior.size() != 3)
            throw GeometryError("GEOS made a piece of a polygon that is no triangle.");
        triangles.push_back({part.exterior[0], part.exterior[1], part.exterior[2]});
    }
    return triangles;
}

double Geos::area_outside(const WorldPolygon& inner, const WorldPolygon& outer) {
    const GeosPolygons& geos = impl_->polygons;
    const GeosInterrupt::Watch watch(geos.stop());
    const GeometryPtr a = geos.polygon(inner);
    const GeometryPtr b = geos.polygon(outer);
    return area_of(geos, geos.own(GEOSDifference_r(geos.context(), a.get(), b.get())));
}

std::string geos_version() {
    const std::string text = GEOSversion();  // "3.11.1-CAPI-1.17.1"
    return text.substr(0, text.find('-'));
}

}  // namespace d2b
