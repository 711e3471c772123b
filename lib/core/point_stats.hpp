#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/int128.hpp"

namespace d2b {

/// Turns elevations into integers whose sums do not depend on their order. Chosen once a run from the largest
/// magnitude, so that nothing of a Float32 elevation near it is lost.
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

  private:
    int shift_ = 0;
    double factor_ = 1;
};

/// Count, sum, lowest and highest of a set of elevations.
struct PointStats {
    Int128 sum = 0;  ///< in FixedPoint
    std::int64_t n = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();

    void add(double elevation, const FixedPoint& fixed) {
        sum += fixed.to_fixed(elevation);
        ++n;
        lowest = std::min(lowest, elevation);
        highest = std::max(highest, elevation);
    }
    void merge(const PointStats& other) {
        sum += other.sum;
        n += other.n;
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
    }
};

}  // namespace d2b
