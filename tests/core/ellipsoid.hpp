#pragma once

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace d2b::test {

inline double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Ellipsoid in closed form, to check areas and lengths against.
struct Ellipsoid {
    double a = 6378137;
    double f = 1 / 298.257223563;
    [[nodiscard]] double e2() const { return f * (2 - f); }

    /// Area between two parallels and two meridians: Snyder's authalic latitude.
    [[nodiscard]] double cell(double south, double north, double degrees) const {
        const double e = std::sqrt(e2());
        const auto q = [&](double latitude) {
            const double s = std::sin(radians(latitude));
            return s / (1 - e2() * s * s) + std::log((1 + e * s) / (1 - e * s)) / (2 * e);
        };
        return a * a * (1 - e2()) / 2 * (q(north) - q(south)) * radians(degrees);
    }
    [[nodiscard]] double parallel(double latitude, double degrees) const {
        const double s = std::sin(radians(latitude));
        return a * std::cos(radians(latitude)) / std::sqrt(1 - e2() * s * s) * radians(degrees);
    }
    /// Length of a meridian by Simpson's rule.
    [[nodiscard]] double meridian(double south, double north) const {
        const auto radius = [&](double latitude) {
            const double s = std::sin(radians(latitude));
            return a * (1 - e2()) / std::pow(1 - e2() * s * s, 1.5);
        };
        constexpr int n = 1000;
        double sum = 0;
        for (int i = 0; i <= n; ++i)
            sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * radius(south + (north - south) * i / n);
        return sum * radians(north - south) / n / 3;
    }
};
inline const Ellipsoid wgs84;
inline const Ellipsoid grs80{6378137, 1 / 298.257222101};

/// Scale of UTM from the easting, in Snyder's series; latitude is that of the footpoint.
inline double utm_scale(double easting, double latitude) {
    const double s2 = std::pow(std::sin(radians(latitude)), 2);
    const double c = grs80.e2() / (1 - grs80.e2()) * (1 - s2);
    const double normal = grs80.a / std::sqrt(1 - grs80.e2() * s2);
    const double d2 = std::pow((easting - 500000) / (normal * 0.9996), 2);
    return 0.9996 * (1 + (1 + c) * d2 / 2 + (1 + 6 * c + 9 * c * c) * d2 * d2 / 24 + d2 * d2 * d2 / 720);
}

inline void expect_near_relative(double value, double truth, double share) {
    EXPECT_NEAR(value / truth, 1, share) << value << " is not " << truth;
}

}  // namespace d2b::test
