#define GEOS_USE_ONLY_R_API
#include "geometry/geos.hpp"

#include <utility>

#include "dem2buildings/error.hpp"
#include "geometry/geos_interrupt.hpp"
#include "geometry/geos_polygons.hpp"
#include "geometry/validity.hpp"

namespace d2b {

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
    const GeometryPtr left = geos.own(GEOSDifference_r(geos.context(), a.get(), b.get()));
    double area = 0;
    if (GEOSArea_r(geos.context(), left.get(), &area) == 0)
        geos.fail("to measure a polygon");
    return area;
}

std::string geos_version() {
    const std::string text = GEOSversion();  // "3.11.1-CAPI-1.17.1"
    return text.substr(0, text.find('-'));
}

}  // namespace d2b
