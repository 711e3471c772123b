#include "diagnose/place_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "options/run_plan.hpp"

namespace d2b {
namespace {

constexpr double widest_degree_cell = 0.001;  // about 100 m
constexpr double narrowest_building_m = 3;

/// Formats a number with three digits.
std::string short_text(double value) {
    if (!(value > 0))
        return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return number_text(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value));
}

}  // namespace

std::string picture_doubt(const DemInfo& dem) {
    constexpr int colours = 3;
    if (dem.bands < colours && !dem.bytes)
        return {};
    const std::string what =
        dem.bands < colours ? "byte values"
                            : std::to_string(dem.bands) + " bands" + (dem.bytes ? " of byte values" : "");
    return "'" + dem.name + "' has " + what +
           ", like a picture; give a surface model (DSM), or choose the band of its elevations with -b";
}

std::string degrees_doubt(const DemInfo& dem, bool has_crs) {
    const AffineTransform& g = dem.transform;
    const double cell = std::max(std::hypot(g[1], g[4]), std::hypot(g[2], g[5]));
    if (has_crs || !dem.georeferenced || cell > widest_degree_cell)
        return {};
    for (const std::int32_t row : {0, dem.rows})
        for (const std::int32_t col : {0, dem.cols})
            if (std::abs(g[0] + col * g[1] + row * g[2]) > 180 ||
                std::abs(g[3] + col * g[4] + row * g[5]) > 90)
                return {};
    return "'" + dem.name +
           "' has no CRS, and its coordinates look like degrees, but were taken as metres; give -a_srs "
           "EPSG:4326 if they are degrees, else their CRS";
}

std::string extent_doubt(const std::string& dem, double width, double height) {
    if (std::min(width, height) >= narrowest_building_m && width * height >= smallest_building_m2)
        return {};
    return "'" + dem + "' covers " + short_text(width) + " m x " + short_text(height) +
           " m, which is less than a building; give the right CRS with -a_srs, or a larger part of the "
           "raster";
}

}  // namespace d2b
