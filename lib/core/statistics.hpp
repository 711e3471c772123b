#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/int128.hpp"
#include "dem2buildings/records.hpp"

namespace d2b {

/// Sum of doubles without rounding, so it does not depend on the order of the summands, on threads or on
/// tiles. A superaccumulator (after Neal 2015) with one wide integer per 32 binary exponents. Exact for up to
/// 2^40 summands of any magnitude, including squares.
class ExactSum {
  public:
    /// @param value finite
    void add(double value);
    void add_square(double value);
    /// Adds value * 2^exponent. @param exponent from -1100 to 1100
    void add_scaled(Int128 value, int exponent);
    void merge(const ExactSum& other);
    /// Returns the exact sum, rounded once.
    [[nodiscard]] double value() const;

    /// The sum is the sum of bin[i] * 2^(32 i + lowest_exponent).
    static constexpr int lowest_exponent = -2176;
    static constexpr std::size_t bin_count = 136;
    [[nodiscard]] const std::array<Int128, bin_count>& bins() const { return bins_; }

  private:
    void add(std::int64_t mantissa, int exponent);

    std::array<Int128, bin_count> bins_{};
};

/// Returns the median, the upper of two; reorders the values. @param values not empty
template <typename T>
[[nodiscard]] T upper_median(std::vector<T>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Number of values, their exact sum and the exact sum of their squares.
struct Moments {
    std::int64_t n = 0;
    ExactSum sum;
    ExactSum squares;

    void add(double value) {
        ++n;
        sum.add(value);
        squares.add_square(value);
    }
    /// Adds all values that are not NaN. Faster than add() because elevations are summed as integers.
    void add_valid(std::span<const double> values);
    void merge(const Moments& other);
    /// Returns the exact mean, rounded once; NaN if n is 0.
    [[nodiscard]] double mean() const;
    /// Returns the sample standard deviation, with n - 1; 0 if n is less than 2.
    [[nodiscard]] double standard_deviation() const;
};

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
    [[nodiscard]] double sum_of_squared_deviations(const Stats& stats) const {
        if (stats.n == 0)
            return 0;
        // Deviations are taken from the integer mean, because n * sum(x^2) - sum(x)^2 may need more than 128
        // bits.
        const Int128 middle = stats.coarse_sum / stats.n;
        const Int128 rest = stats.coarse_sum - middle * stats.n;  // less than n
        const Int128 about_middle =
            stats.coarse_squares - 2 * middle * stats.coarse_sum + middle * middle * stats.n;
        const double sum_of_squared_deviations =
            static_cast<double>(about_middle) -
            static_cast<double>(rest) * (static_cast<double>(rest) / static_cast<double>(stats.n));
        return std::max(0.0, squares(sum_of_squared_deviations));
    }
    /// Sample standard deviation. @pre stats.n > 1
    template <typename Stats>
    [[nodiscard]] double standard_deviation(const Stats& stats) const {
        return std::sqrt(sum_of_squared_deviations(stats) / static_cast<double>(stats.n - 1));
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

/// Range divided into the bins of a histogram. The same for a whole run, so that histograms can be merged.
struct ElevationRange {
    double minimum = 0;
    double maximum = 0;

    static constexpr std::uint32_t bins = 65536;
    [[nodiscard]] std::uint32_t bin(double elevation) const;
    /// Returns the centre of the bin.
    [[nodiscard]] double elevation(std::uint32_t bin) const;
};

/// Elevations of a building, for percentiles. Exact up to 2^17 points (1 MiB); above that, a histogram of 512
/// KiB with a resolution of 1/65,536 of the DEM's range. The choice depends only on the number of points, so
/// the result does not depend on their order.
class ElevationSample {
  public:
    static constexpr std::size_t largest_list = std::size_t{1} << 17;

    void add(double elevation, const ElevationRange& range);
    /// Adds all values that are not NaN.
    void add(std::span<const double> elevations, const ElevationRange& range);
    /// @param other left empty
    void merge(ElevationSample& other, const ElevationRange& range);
    [[nodiscard]] std::int64_t size() const { return size_; }
    /// Computes percentiles by nearest rank: the lowest elevation that at least this share of the points does
    /// not exceed. A share of 1 gives the maximum, which is always exact. @param shares 0 to 1, ascending
    /// @pre size() > 0
    [[nodiscard]] std::vector<double> percentiles(const std::vector<double>& shares,
                                                  const ElevationRange& range) const;

  private:
    void make_histogram(const ElevationRange& range);
    void count(double elevation, const ElevationRange& range);

    std::int64_t size_ = 0;
    std::vector<double> values_;
    std::vector<std::uint32_t> histogram_;
    double highest_ = -std::numeric_limits<double>::infinity();  ///< maximum of the values in the histogram
};

/// Elevations of a roof from the points of a building, without its spires. NaN if there are no such points.
struct RoofElevations {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Percentiles percentiles{unknown, unknown, unknown, unknown};
    double highest = unknown;

    friend bool operator==(const RoofElevations&, const RoofElevations&) = default;
};

/// Returns the percentiles as heights above ground in metres. @param metres in one vertical unit
[[nodiscard]] Percentiles heights_above(double ground, const RoofElevations& roof, double metres);

/// Computed as soon as a building is complete, so that its sample can be released.
[[nodiscard]] RoofElevations summarize_roof(const ElevationSample& sample, const ElevationRange& range);

}  // namespace d2b
