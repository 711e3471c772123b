#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/int128.hpp"

namespace d2b {

/// Converts elevations to integers, because integer sums do not depend on the order. The scale is chosen once
/// per run from the largest magnitude, so that Float32 elevations near it are exact.
class FixedPoint {
  public:
    FixedPoint() = default;
    /// @param largest_magnitude of all elevations; finite
    explicit FixedPoint(double largest_magnitude)
        : shift_(std::clamp(60 - (largest_magnitude > 0 ? std::ilogb(largest_magnitude) : 0), -1000, 1000)),
          factor_(std::ldexp(1.0, shift_)) {}

    [[nodiscard]] std::int64_t to_fixed(double elevation) const {
        return static_cast<std::int64_t>(elevation * factor_);
    }
    /// @param n more than 0
    [[nodiscard]] double mean(Int128 sum, std::int64_t n) const {
        const Int128 whole = sum / n;
        const auto rest = static_cast<double>(sum % n) / static_cast<double>(n);
        return std::ldexp(static_cast<double>(whole) + rest, -shift_);
    }

    /// Keeps some 30 binary digits of an elevation, so that squares can be summed.
    [[nodiscard]] static std::int64_t coarse(std::int64_t fixed) { return fixed >> coarse_shift; }
    /// Converts a sum of squares of coarse values to squared elevations.
    [[nodiscard]] double squares(double coarse_squares) const {
        return std::ldexp(coarse_squares, 2 * (coarse_shift - shift_));
    }
    /// Returns the sum of squared deviations from the mean.
    template <typename Stats>
    [[nodiscard]] double scatter(const Stats& stats) const {
        if (stats.n == 0)
            return 0;
        // Deviations are taken from the integer mean, because n * sum(x^2) - sum(x)^2 may need more than 128
        // bits.
        const Int128 middle = stats.coarse_sum / stats.n;
        const Int128 rest = stats.coarse_sum - middle * stats.n;  // less than n
        const Int128 about_middle =
            stats.coarse_squares - 2 * middle * stats.coarse_sum + middle * middle * stats.n;
        const double scatter =
            static_cast<double>(about_middle) -
            static_cast<double>(rest) * (static_cast<double>(rest) / static_cast<double>(stats.n));
        return std::max(0.0, squares(scatter));
    }
    /// Sample standard deviation. @pre stats.n > 1
    template <typename Stats>
    [[nodiscard]] double standard_deviation(const Stats& stats) const {
        return std::sqrt(scatter(stats) / static_cast<double>(stats.n - 1));
    }

  private:
    static constexpr int coarse_shift = 30;
    int shift_ = 0;
    double factor_ = 1;
};

/// Count, sum, sum of squares, minimum and maximum of a set of elevations.
struct PointStats {
    Int128 sum = 0;             ///< sum of FixedPoint values
    Int128 coarse_sum = 0;      ///< sum of FixedPoint::coarse() values
    Int128 coarse_squares = 0;  ///< sum of their squares
    std::int64_t n = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();

    void add(double elevation, const FixedPoint& fixed) { add(elevation, 1, fixed); }
    /// Adds an elevation `times` times.
    void add(double elevation, std::int64_t times, const FixedPoint& fixed) {
        const std::int64_t z = fixed.to_fixed(elevation);
        sum += Int128{z} * times;
        const std::int64_t c = FixedPoint::coarse(z);
        coarse_sum += Int128{c} * times;
        coarse_squares += Int128{c} * c * times;
        n += times;
        lowest = std::min(lowest, elevation);
        highest = std::max(highest, elevation);
    }
    void merge(const PointStats& other) {
        sum += other.sum;
        coarse_sum += other.coarse_sum;
        coarse_squares += other.coarse_squares;
        n += other.n;
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
    }
};

}  // namespace d2b
