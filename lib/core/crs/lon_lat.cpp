#include "core/crs/lon_lat.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace d2b {
namespace {

bool read_ellipsoid(LonLat& result, const PJ* geographic) {
    PJ_CONTEXT* context = result.context.get();
    const PjPtr ellipsoid(proj_get_ellipsoid(context, geographic));
    double polar_radius = 0;
    double inverse_flattening = 0;
    if (!ellipsoid || !proj_ellipsoid_get_parameters(context, ellipsoid.get(), &result.radius, &polar_radius,
                                                     nullptr, &inverse_flattening))
        return false;
    result.flattening = inverse_flattening == 0 ? 0 : 1 / inverse_flattening;
    const PjPtr meridian(proj_get_prime_meridian(context, geographic));
    double longitude = 0;
    double radians = 0;
    if (meridian &&
        proj_prime_meridian_get_parameters(context, meridian.get(), &longitude, &radians, nullptr))
        result.prime_meridian = longitude * to_degrees(radians);
    return std::isfinite(result.radius) && result.radius > 0 && result.flattening < 1;
}

/// Moves bounds off the antimeridian, because PROJ 9.1 recurses until the stack overflows for an area beyond
/// 180 or -180 degrees.
std::pair<double, double> avoid_antimeridian(std::pair<double, double> range) {
    constexpr double half = 180;
    auto& [west, east] = range;
    if (west == east)
        return west == half ? std::pair(-half, -half) : range;
    if (west == half)
        west = -half;
    if (east == -half)
        east = half;
    return range;
}

}  // namespace

std::pair<double, double> longitude_range(std::span<const Position> places, double turn) {
    std::vector<double> longitudes;
    longitudes.reserve(places.size());
    for (const Position& place : places)
        longitudes.push_back(std::remainder(place.x, turn));
    std::ranges::sort(longitudes);
    std::pair<double, double> range{longitudes.front(), longitudes.back()};
    double widest = longitudes.front() + turn - longitudes.back();
    for (std::size_t i = 1; i < longitudes.size(); ++i)
        if (longitudes[i] - longitudes[i - 1] > widest) {
            widest = longitudes[i] - longitudes[i - 1];
            range = {longitudes[i], longitudes[i - 1]};
        }
    return range;
}

std::unique_ptr<LonLat> LonLat::copy() const {
    auto result = std::make_unique<LonLat>();
    result->degrees = degrees;
    result->prime_meridian = prime_meridian;
    result->radius = radius;
    result->flattening = flattening;
    if (operation)
        result->operation.reset(proj_clone(result->context.get(), operation.get()));
    return operation && !result->operation ? nullptr : std::move(result);
}

void LonLat::apply(std::span<Position> positions) const {
    if (operation)
        transform_in_place(operation.get(), positions);
    for (Position& p : positions) {
        p = {p.x * degrees, p.y * degrees};
        if (!(std::abs(p.y) <= 90))  // rounding may overshoot a pole
            p.y = std::abs(p.y) <= 90 + 1e-9 ? std::copysign(90.0, p.y)
                                             : std::numeric_limits<double>::infinity();
    }
}

std::unique_ptr<LonLat> lon_lat_of(const PJ* horizontal) {
    auto result = std::make_unique<LonLat>();
    PJ_CONTEXT* context = result->context.get();
    const PjPtr crs = unbound(context, PjPtr(proj_clone(context, horizontal)));
    const Crs::Kind kind = kind_of(context, crs.get());
    if (kind != Crs::Kind::projected && kind != Crs::Kind::geographic)
        return nullptr;
    PjPtr base(proj_crs_get_geodetic_crs(context, crs.get()));
    while (base && proj_crs_is_derived(context, base.get()))  // rotated poles
        base.reset(proj_get_source_crs(context, base.get()));
    if (!base || kind_of(context, base.get()) != Crs::Kind::geographic ||
        !read_ellipsoid(*result, base.get()))
        return nullptr;
    const std::optional<AxisUnit> unit = axis_unit(context, base.get(), 0);
    if (!unit)
        return nullptr;
    result->degrees = to_degrees(unit->factor);
    if (kind == Crs::Kind::geographic && !proj_crs_is_derived(context, crs.get()))
        return result;
    result->operation = operation_between(context, crs.get(), base.get(), nullptr);
    return result->operation ? std::move(result) : nullptr;
}

AreaPtr area_of(const PJ* crs, std::span<const Position> positions) {
    const std::unique_ptr<LonLat> lon_lat = lon_lat_of(crs);
    if (!lon_lat)
        return nullptr;
    std::vector<Position> places(positions.begin(), positions.end());
    lon_lat->apply(places);
    std::erase_if(places, [](const Position& p) { return !is_finite(p); });
    if (places.empty())
        return nullptr;
    double south = 90;
    double north = -90;
    for (Position& p : places) {
        p.x += lon_lat->prime_meridian;
        south = std::min(south, p.y);
        north = std::max(north, p.y);
    }
    const auto [west, east] = avoid_antimeridian(longitude_range(places, 360));
    AreaPtr area(proj_area_create());
    proj_area_set_bbox(area.get(), west, south, east, north);
    return area;
}

}  // namespace d2b
