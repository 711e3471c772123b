#pragma once

#include <cmath>

namespace d2b {

/// What the data can carry of a length, an area or a volume: the nearest hundredth, of a metre a centimetre.
/// NaN stays NaN.
[[nodiscard]] inline double to_hundredths(double value) {
    return std::round(value * 100) / 100;
}

/// Two digits of a share, not rounded up: what is below a bound of two digits is below it afterwards, too.
[[nodiscard]] inline double down_to_hundredths(double share) {
    constexpr double slack = 1e-9;  // 0.29 * 100 is less than 29
    return std::floor(share * 100 + slack) / 100;
}

}  // namespace d2b
