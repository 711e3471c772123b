#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "core/crs.hpp"
#include "core/crs/crs_impl.hpp"
#include "core/crs/geodesic_meter.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/position_math.hpp"
#include "core/crs/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Relative to the first position, because differences of large coordinates are exact enough.
Geodesy::Measure planar_ring(std::span<const Position> ring, double metres) {
    double twice_area = 0;
    double perimeter = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i];
        const Position& q = ring[(i + 1) % ring.size()];
        if (!is_finite(p))
            throw InputError("Position " + position_text(p) + " is not finite; check the georeferencing.");
        const Position& o = ring[0];
        twice_area += (p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y);
        perimeter += std::hypot(q.x - p.x, q.y - p.y);
    }
    return {std::abs(twice_area) / 2 * metres * metres, perimeter * metres};
}

/// Returns some 50 km on the ground, or half a degree, in units of the CRS.
double longest_edge(const Crs::Impl& crs, double radius) {
    if (crs.angular_unit > 0)
        return 0.5 / crs.angular_unit;
    return radius / 128 / (crs.horizontal_unit ? crs.horizontal_unit->metres : 1);
}

}  // namespace

struct Geodesy::Impl {
    std::optional<GeodesicMeter> geodesic;  ///< empty if planar
    double metres = 1;                      ///< in one unit, if planar
    StopRequest stop;
};

Geodesy::Geodesy(const Crs& crs, StopRequest stop) : impl_(std::make_unique<Impl>()) {
    impl_->stop = std::move(stop);
    const Crs::Impl& definition = crs.impl();
    if (definition.horizontal_unit)
        impl_->metres = definition.horizontal_unit->metres;
    std::unique_ptr<LonLat> lon_lat = definition.lon_lat ? definition.lon_lat->copy() : nullptr;
    if (!lon_lat)
        return;
    const double step = longest_edge(definition, lon_lat->radius);
    impl_->geodesic.emplace(std::move(lon_lat), definition.name, step, crs.turn(), impl_->stop);
}

Geodesy::Geodesy(Geodesy&&) noexcept = default;
Geodesy& Geodesy::operator=(Geodesy&&) noexcept = default;
Geodesy::~Geodesy() = default;

bool Geodesy::geodesic() const {
    return impl_->geodesic.has_value();
}

Geodesy::Measure Geodesy::ring(std::span<const Position> ring) {
    return impl_->geodesic ? impl_->geodesic->ring(ring) : planar_ring(ring, impl_->metres);
}

Geodesy::Measure Geodesy::polygon(const WorldPolygon& polygon) {
    Measure sum = ring(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors) {
        impl_->stop.check();
        const Measure hole = ring(interior);
        sum.area_m2 -= hole.area_m2;
        sum.perimeter_m += hole.perimeter_m;
    }
    sum.area_m2 = std::max(sum.area_m2, 0.0);
    return sum;
}

}  // namespace d2b
