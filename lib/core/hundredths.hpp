#pragma once

#include <cmath>

namespace d2b {

/// Rounds a length, area or volume to hundredths, because the data carry no more: a centimetre in a metre.
/// NaN stays NaN.
[[nodiscard]] inline double to_hundredths(double value) {
    return std::round(value * 100) / 100;
}

/// Rounds a share down to two digits, so that a share below a bound of two digits stays below it.
[[nodiscard]] inline double down_to_hundredths(double share) {
    constexpr double slack = 1e-9;  // 0.29 * 100 is less than 29
    return std::floor(share * 100 + slack) / 100;
}

}  // namespace d2b
