#include "core/crs/area_of_interest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/crs/lon_lat.hpp"
#include "core/crs/position_math.hpp"

namespace d2b {
namespace {

/// Moves bounds off the antimeridian, because PROJ 9.1 recurses until the stack overflows for an area beyond
/// 180 or -180 degrees.
std::pair<double, double> off_the_antimeridian(std::pair<double, double> range) {
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

/// Returns the smallest range that holds all longitudes: the circle without its widest gap. If the first is
/// east of the second, the range crosses the antimeridian.
std::pair<double, double> longitude_range(std::vector<double> longitudes) {
    std::sort(longitudes.begin(), longitudes.end());
    std::pair<double, double> range{longitudes.front(), longitudes.back()};
    double widest = longitudes.front() + 360 - longitudes.back();
    for (std::size_t i = 1; i < longitudes.size(); ++i) {
        if (longitudes[i] - longitudes[i - 1] > widest) {
            widest = longitudes[i] - longitudes[i - 1];
            range = {longitudes[i], longitudes[i - 1]};
        }
    }
    return range;
}

}  // namespace

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
    std::vector<double> longitudes;
    for (const Position& p : places) {
        longitudes.push_back(std::remainder(p.x + lon_lat->prime_meridian, 360.0));
        south = std::min(south, p.y);
        north = std::max(north, p.y);
    }
    const auto [west, east] = off_the_antimeridian(longitude_range(std::move(longitudes)));
    AreaPtr area(proj_area_create());
    proj_area_set_bbox(area.get(), west, south, east, north);
    return area;
}

}  // namespace d2b
