#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/int128.hpp"

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
    void add_known(std::span<const double> values);
    void merge(const Moments& other);
    /// Returns the exact mean, rounded once; NaN if n is 0.
    [[nodiscard]] double mean() const;
    /// Returns the sample standard deviation, with n - 1; 0 if n is less than 2.
    [[nodiscard]] double standard_deviation() const;
};

}  // namespace d2b
