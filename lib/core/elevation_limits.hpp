#pragma once

#include <limits>

namespace d2b {

/// The elevations that are taken for such, in any unit: what lies outside is no elevation. By default
/// whatever is finite.
struct ElevationLimits {
    double lowest = -std::numeric_limits<double>::max();
    double highest = std::numeric_limits<double>::max();

    /// Not NaN.
    [[nodiscard]] bool hold(double elevation) const { return elevation >= lowest && elevation <= highest; }
    /// The same in another unit. @param factor of these units in one of those
    [[nodiscard]] ElevationLimits times(double factor) const { return {lowest * factor, highest * factor}; }
};

/// Metres. No shore lies lower than that of the Dead Sea at -430 m and no summit higher than 8,849 m; an
/// opencast mine may be some 300 m deep.
inline constexpr ElevationLimits on_land{-500, 9000};

}  // namespace d2b
