#include "core/crs/geodesic_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <GeographicLib/Math.hpp>

namespace d2b {

/// Small rings are measured separately, because PolygonArea sums areas between edges and the equator, whose
/// rounding errors (up to 1e-5 m2 per edge) matter for a house.
Geodesy::Measure GeodesicPolygon::measure(std::span<const Position> places) {
    constexpr double near = 0.15;  // degrees of a great circle, about 17 km
    const Position& first = places[0];
    const double shrink = std::cos(first.y * GeographicLib::Math::degree());
    if (std::all_of(places.begin(), places.end(), [&](const Position& p) {
            return std::abs(p.y - first.y) <= near &&
                   std::abs(std::remainder(p.x - first.x, 360.0)) * shrink <= near;
        }))
        return measure_near(places);
    wide_.Clear();
    for (const Position& p : places)
        wide_.AddPoint(p.y, p.x);
    Geodesy::Measure result;
    wide_.Compute(false, true, result.perimeter_m, result.area_m2);
    result.area_m2 = std::abs(result.area_m2);
    return result;
}

/// Sums a fan of geodesic triangles about the first position, each with two sides and the angle between them.
/// Within 50 km, a triangle on the sphere with the local Gaussian curvature is accurate to 1e-9 of its area.
Geodesy::Measure GeodesicPolygon::measure_near(std::span<const Position> places) const {
    struct Ray {
        double length = 0;   ///< divided by the radius
        double azimuth = 0;  ///< radians
        double sine = 0;     ///< of the length
        double half_tangent = 0;
    };
    const Position& first = places[0];
    const double e2 = earth_.Flattening() * (2 - earth_.Flattening());
    const double sine = std::sin(first.y * GeographicLib::Math::degree());
    const double radius = earth_.EquatorialRadius() * std::sqrt(1 - e2) / (1 - e2 * sine * sine);
    double half_excess = 0;
    double perimeter = 0;
    Ray last;
    for (std::size_t i = 1; i <= places.size(); ++i) {
        Ray ray;
        if (i < places.size()) {
            double unused = 0;
            earth_.Inverse(first.y, first.x, places[i].y, places[i].x, ray.length, ray.azimuth, unused);
            ray.length /= radius;
            ray.azimuth *= GeographicLib::Math::degree();
            ray.sine = std::sin(ray.length);
            ray.half_tangent = std::tan(ray.length / 2);
        }
        const double angle = ray.azimuth - last.azimuth;
        const double tangents = ray.half_tangent * last.half_tangent;
        half_excess += std::atan2(tangents * std::sin(angle), 1 + tangents * std::cos(angle));
        const double across = std::sin(angle / 2);
        const double along = std::sin((ray.length - last.length) / 2);
        perimeter += 2 * std::asin(std::sqrt(along * along + ray.sine * last.sine * across * across));
        last = ray;
    }
    return {2 * std::abs(half_excess) * radius * radius, perimeter * radius};
}

double GeodesicPolygon::sag(const Position& a, const Position& middle, const Position& b) const {
    double distance = 0;
    double azimuth_middle = 0;
    double azimuth_b = 0;
    double unused = 0;
    earth_.Inverse(a.y, a.x, b.y, b.x, azimuth_b, unused);
    earth_.Inverse(a.y, a.x, middle.y, middle.x, distance, azimuth_middle, unused);
    return std::abs(distance * std::sin((azimuth_middle - azimuth_b) * GeographicLib::Math::degree()));
}

}  // namespace d2b
