#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/crs.hpp"
#include "core/crs/lon_lat.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// a + b x + c y + d x^2 + e x y + f y^2.
struct Quadratic {
    std::array<double, 6> terms{};

    [[nodiscard]] double at(double x, double y) const {
        const auto& [a, b, c, d, e, f] = terms;
        return a + x * (b + d * x + e * y) + y * (c + f * y);
    }
    /// Returns the same function of x - x0 and y - y0.
    [[nodiscard]] Quadratic about(double x0, double y0) const;
};

/// Lengths and areas on the ellipsoid near a position of a CRS, from the first fundamental form ds^2 = E dx^2
/// + 2 F dx dy + G dy^2 with coefficients approximated by quadratic polynomials. Edges are straight in the
/// CRS, whatever their length. Much faster than geodesics, because a ring costs only arithmetic per edge.
class LocalMetric {
  public:
    /// Fits the form for positions less than `reach` from the centre along either axis.
    /// @returns nothing if the relative error exceeds 2e-8, as it does near poles and the antimeridian, or if
    /// `reach` is too large
    [[nodiscard]] static std::optional<LocalMetric> fit(const Position& centre, double reach,
                                                        const LonLat& lon_lat);

    [[nodiscard]] Geodesy::Measure ring(std::span<const Position> corners) const;

  private:
    Position centre_;
    Quadratic along_x_;  ///< E
    Quadratic mixed_;    ///< F
    Quadratic along_y_;  ///< G
    Quadratic area_;     ///< sqrt(E G - F^2)
};

}  // namespace d2b
