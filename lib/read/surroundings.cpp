#include "read/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {
namespace {

constexpr double margin = 4;  // in sizes of the window

/// Returns a lattice of points over the window, because its rim alone would miss a pole inside.
std::vector<Position> places_of(const DemInfo& info) {
    constexpr int n = 16;
    const AffineTransform& g = info.transform;
    std::vector<Position> places;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) {
            const double row = info.window.row + static_cast<double>(info.window.rows) * i / n;
            const double col = info.window.col + static_cast<double>(info.window.cols) * k / n;
            places.push_back({g[0] + col * g[1] + row * g[2], g[3] + col * g[4] + row * g[5]});
        }
    return places;
}

/// Returns the smallest range that contains all longitudes: the circle without its widest gap. It may end
/// beyond half a turn.
std::pair<double, double> range_of_longitudes(std::vector<double> longitudes, double turn) {
    for (double& longitude : longitudes)
        longitude = std::remainder(longitude, turn);
    std::ranges::sort(longitudes);
    std::pair<double, double> range{longitudes.front(), longitudes.back()};
    double widest = longitudes.front() + turn - longitudes.back();
    for (std::size_t i = 1; i < longitudes.size(); ++i)
        if (longitudes[i] - longitudes[i - 1] > widest) {
            widest = longitudes[i] - longitudes[i - 1];
            range = {longitudes[i], longitudes[i - 1] + turn};
        }
    return range;
}

/// Returns a full circle of longitude in units of the CRS, or 0 for projected ones.
double turn_of(OGRSpatialReferenceH crs) {
    return OSRIsGeographic(crs) != FALSE ? 2 * std::numbers::pi / OSRGetAngularUnits(crs, nullptr) : 0;
}

}  // namespace

Surroundings surroundings(OGRSpatialReferenceH polygons, OGRSpatialReferenceH dem, const DemInfo& info) {
    const GdalMessages quiet;
    const TransformOwner back(OCTNewCoordinateTransformation(dem, polygons));
    std::vector<double> xs;
    std::vector<double> ys;
    for (Position p : places_of(info)) {
        if (!back || OCTTransform(back.get(), 1, &p.x, &p.y, nullptr) == FALSE || !std::isfinite(p.x + p.y))
            return {};
        xs.push_back(p.x);
        ys.push_back(p.y);
    }
    const auto [bottom, top] = std::ranges::minmax(ys);
    const auto [least, most] = std::ranges::minmax(xs);
    const double turn = turn_of(polygons);
    const auto [left, right] = turn > 0 ? range_of_longitudes(std::move(xs), turn) : std::pair(least, most);
    const double room = margin * std::max(right - left, top - bottom);
    ClipBox box{left - room, bottom - room, right + room, top + room};
    if (!(turn > 0))
        return {{box}, {}};
    Surroundings found;
    found.earth.top = turn / 4 * (1 + 1e-9);
    found.earth.bottom = -found.earth.top;
    if (box.right - box.left >= turn) {
        box.left = found.earth.left;
        box.right = found.earth.right;
        found.boxes = {box};
        return found;
    }
    for (const double shift : {0.0, -turn, turn})
        found.boxes.push_back({box.left + shift, box.bottom, box.right + shift, box.top});
    return found;
}

}  // namespace d2b
