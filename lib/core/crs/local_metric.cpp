#include "core/crs/local_metric.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace d2b {
namespace {

/// The form is sampled on a lattice of n x n positions. Their spacing is the unit of length below.
constexpr int n = 5;
constexpr int middle = n / 2;
constexpr std::size_t samples = std::size_t{n} * n;
using Samples = std::array<double, samples>;

std::size_t index(int col, int row) {
    return static_cast<std::size_t>(row) * n + static_cast<std::size_t>(col);
}

/// Coefficients of the derivative at each of five samples, exact up to the fourth power.
constexpr std::array<std::array<double, n>, n> derivative{{
    {-25.0 / 12, 4, -3, 4.0 / 3, -1.0 / 4},
    {-1.0 / 4, -5.0 / 6, 3.0 / 2, -1.0 / 2, 1.0 / 12},
    {1.0 / 12, -2.0 / 3, 0, 2.0 / 3, -1.0 / 12},
    {-1.0 / 12, 1.0 / 2, -3.0 / 2, 5.0 / 6, 1.0 / 4},
    {1.0 / 4, -4.0 / 3, 3, -4, 25.0 / 12},
}};

double slope_along_x(const Samples& values, int col, int row) {
    double sum = 0;
    for (int k = 0; k < n; ++k)
        sum += derivative[static_cast<std::size_t>(col)][static_cast<std::size_t>(k)] * values[index(k, row)];
    return sum;
}

double slope_along_y(const Samples& values, int col, int row) {
    double sum = 0;
    for (int k = 0; k < n; ++k)
        sum += derivative[static_cast<std::size_t>(row)][static_cast<std::size_t>(k)] * values[index(col, k)];
    return sum;
}

/// Least-squares fit over the lattice. Symmetry leaves two small systems.
Quadratic fitted(const Samples& values) {
    constexpr double squares = 2.0 * n * (1 + 4);        // sum of x^2
    constexpr double fourths = 2.0 * n * (1 + 16);       // sum of x^4
    constexpr double crossed = 4.0 * (1 + 4) * (1 + 4);  // sum of x^2 y^2
    constexpr double count = samples;
    double sum = 0;
    double x1 = 0;
    double y1 = 0;
    double x2 = 0;
    double y2 = 0;
    double xy = 0;
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col) {
            const double x = col - middle;
            const double y = row - middle;
            const double value = values[index(col, row)];
            sum += value;
            x1 += x * value;
            y1 += y * value;
            x2 += x * x * value;
            y2 += y * y * value;
            xy += x * y * value;
        }
    // With x^2 and y^2 minus their means, all terms are orthogonal on the lattice.
    const double mean_square = squares / count;
    const double spread = fourths - squares * mean_square;
    const double d = (x2 - mean_square * sum) / spread;
    const double f = (y2 - mean_square * sum) / spread;
    return {{sum / count - mean_square * (d + f), x1 / squares, y1 / squares, d, xy / crossed, f}};
}

/// Returns the largest residual, relative to `scale`.
double relative_residual(const Quadratic& fit, const Samples& values, double scale) {
    double largest = 0;
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col)
            largest =
                std::max(largest, std::abs(fit.at(col - middle, row - middle) - values[index(col, row)]));
    return largest / scale;
}

/// Converts from units of the lattice to those of the CRS.
Quadratic scaled(Quadratic fit, double unit) {
    auto& [a, b, c, d, e, f] = fit.terms;
    b /= unit;
    c /= unit;
    d /= unit * unit;
    e /= unit * unit;
    f /= unit * unit;
    return fit;
}

struct Places {
    Samples longitude{};  ///< radians
    Samples latitude{};
};

std::optional<Places> sample(const Position& centre, double unit, const LonLat& lon_lat) {
    std::array<Position, samples> positions;
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col)
            positions[index(col, row)] = {centre.x + unit * (col - middle), centre.y + unit * (row - middle)};
    lon_lat.apply(positions);
    if (!std::ranges::all_of(positions, is_finite))
        return std::nullopt;
    Places places;
    for (std::size_t i = 0; i < samples; ++i) {
        // Differences from the first longitude keep more digits.
        places.longitude[i] = (positions[i].x - positions[0].x) * std::numbers::pi / 180;
        places.latitude[i] = positions[i].y * std::numbers::pi / 180;
    }
    return places;
}

}  // namespace

Quadratic Quadratic::about(double x0, double y0) const {
    const auto& [a, b, c, d, e, f] = terms;
    return {{at(x0, y0), b + 2 * d * x0 + e * y0, c + 2 * f * y0 + e * x0, d, e, f}};
}

std::optional<LocalMetric> LocalMetric::fit(const Position& centre, double reach, const LonLat& lon_lat) {
    constexpr double max_residual = 2e-8;
    const double unit = reach / middle;
    const std::optional<Places> places = sample(centre, unit, lon_lat);
    if (!places)
        return std::nullopt;
    const double e2 = lon_lat.flattening * (2 - lon_lat.flattening);
    Samples along_x{};
    Samples mixed{};
    Samples along_y{};
    Samples area{};
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col) {
            const std::size_t i = index(col, row);
            const double sine = std::sin(places->latitude[i]);
            const double w2 = 1 - e2 * sine * sine;
            const double normal = lon_lat.radius / std::sqrt(w2);  // radius of curvature across the meridian
            const double meridian = normal * (1 - e2) / w2;        // radius of curvature along the meridian
            const double parallel = normal * std::cos(places->latitude[i]);
            const double east_x = parallel * slope_along_x(places->longitude, col, row) / unit;
            const double north_x = meridian * slope_along_x(places->latitude, col, row) / unit;
            const double east_y = parallel * slope_along_y(places->longitude, col, row) / unit;
            const double north_y = meridian * slope_along_y(places->latitude, col, row) / unit;
            along_x[i] = east_x * east_x + north_x * north_x;
            mixed[i] = east_x * east_y + north_x * north_y;
            along_y[i] = east_y * east_y + north_y * north_y;
            area[i] = std::abs(east_x * north_y - east_y * north_x);
        }
    LocalMetric metric;
    metric.centre_ = centre;
    metric.along_x_ = fitted(along_x);
    metric.mixed_ = fitted(mixed);
    metric.along_y_ = fitted(along_y);
    metric.area_ = fitted(area);
    const double scale = area[index(middle, middle)];
    if (!(std::max({relative_residual(metric.along_x_, along_x, scale),
                    relative_residual(metric.mixed_, mixed, scale),
                    relative_residual(metric.along_y_, along_y, scale),
                    relative_residual(metric.area_, area, scale)}) <= max_residual))
        return std::nullopt;
    for (Quadratic* form : {&metric.along_x_, &metric.mixed_, &metric.along_y_, &metric.area_})
        *form = scaled(*form, unit);
    return metric;
}

Geodesy::Measure LocalMetric::ring(std::span<const Position> corners) const {
    // Relative to the first corner, because differences of large coordinates are exact enough.
    const Position& origin = corners[0];
    const double x0 = origin.x - centre_.x;
    const double y0 = origin.y - centre_.y;
    const Quadratic along_x = along_x_.about(x0, y0);
    const Quadratic mixed = mixed_.about(x0, y0);
    const Quadratic along_y = along_y_.about(x0, y0);
    const auto [a, b, c, d, e, f] = area_.about(x0, y0).terms;
    const double gauss = 0.5 / std::numbers::sqrt3;  // two points integrate a cubic exactly
    double area = 0;
    double perimeter = 0;
    double px = 0;
    double py = 0;
    for (std::size_t i = 1; i <= corners.size(); ++i) {
        const double qx = i < corners.size() ? corners[i].x - origin.x : 0;
        const double qy = i < corners.size() ? corners[i].y - origin.y : 0;
        const double dx = qx - px;
        const double dy = qy - py;
        const double mx = px + dx / 2;
        const double my = py + dy / 2;
        perimeter += std::sqrt(along_x.at(mx, my) * dx * dx + 2 * mixed.at(mx, my) * dx * dy +
                               along_y.at(mx, my) * dy * dy);
        if (dy != 0)
            for (const double side : {-gauss, gauss}) {
                const double x = mx + side * dx;
                const double y = my + side * dy;
                area += x * (a + x * (b / 2 + d * x / 3 + e * y / 2) + y * (c + f * y)) * dy / 2;
            }
        px = qx;
        py = qy;
    }
    return {std::abs(area), perimeter};
}

}  // namespace d2b
