#pragma once

#include <limits>

namespace d2b {

/// Valid range of elevations in any unit. Values outside it are not elevations. Holds every finite value by
/// default.
struct ElevationLimits {
    double lowest = -std::numeric_limits<double>::max();
    double highest = std::numeric_limits<double>::max();

    /// Returns true if the elevation is in the range; false for NaN.
    [[nodiscard]] bool hold(double elevation) const { return elevation >= lowest && elevation <= highest; }
    /// Converts to another unit. @param factor new units per old unit
    [[nodiscard]] ElevationLimits times(double factor) const { return {lowest * factor, highest * factor}; }
};

/// Metres. The lowest shore is that of the Dead Sea at -430 m, the highest summit 8,849 m; opencast mines may
/// be some 300 m deep.
inline constexpr ElevationLimits on_land{-500, 9000};

}  // namespace d2b
