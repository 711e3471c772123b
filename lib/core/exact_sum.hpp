#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/int128.hpp"

namespace d2b {

/// The sum of doubles without rounding: the order in which they come, threads and tiles do not matter.
/// A superaccumulator (after Neal 2015): one wide integer for each 32 binary exponents; exact for up to 2^40
/// summands of any size, so of squares, too.
class ExactSum {
  public:
    /// @param value finite
    void add(double value);
    void add_square(double value);
    /// Adds value * 2^exponent. @param exponent from -1100 to 1100
    void add_scaled(Int128 value, int exponent);
    void merge(const ExactSum& other);
    /// Rounded once from the exact value.
    [[nodiscard]] double value() const;

    /// The sum is the sum of bin[i] * 2^(32 i + lowest_exponent).
    static constexpr int lowest_exponent = -2176;
    static constexpr std::size_t bin_count = 136;
    [[nodiscard]] const std::array<Int128, bin_count>& bins() const { return bins_; }

  private:
    void add(std::int64_t mantissa, int exponent);

    std::array<Int128, bin_count> bins_{};
};

/// n values, their exact sum and the exact sum of their squares.
struct Moments {
    std::int64_t n = 0;
    ExactSum sum;
    ExactSum squares;

    void add(double value) {
        ++n;
        sum.add(value);
        squares.add_square(value);
    }
    /// The same for each that is not NaN, sooner: elevations are added up as whole numbers.
    void add_known(std::span<const double> values);
    void merge(const Moments& other);
    /// Rounded once from the exact value. @return NaN where n is 0
    [[nodiscard]] double mean() const;
    /// The sample standard deviation, with n - 1. @return 0 where n is less than 2
    [[nodiscard]] double standard_deviation() const;
};

}  // namespace d2b
