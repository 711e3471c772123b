#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/text.hpp"

namespace d2b {

/// m: larger difference between the 90th percentile and the median of a building's heights means roofs at
/// several heights, so that one number misleads.
inline constexpr double one_roof_m = 5;

/// Returns true if the roofs of a building lie at several heights; false if a height is not known.
[[nodiscard]] inline bool has_several_roofs(double p50, double p90) {
    return p90 - p50 > one_roof_m;
}

/// Returns a height with one decimal below 10 m, in whole metres from there on.
[[nodiscard]] inline std::string height_number(double height_m) {
    constexpr double whole_from = 10;
    return fixed_text(height_m, std::abs(height_m) < whole_from ? 1 : 0);
}

/// Returns the label of a building in metres: its p90, or "12-25", from its median to its p90, if its roofs
/// lie at several heights.
[[nodiscard]] inline std::string height_range_text(double p50, double p90) {
    return (has_several_roofs(p50, p90) ? height_number(std::max(p50, 0.0)) + "-" : "") + height_number(p90);
}

}  // namespace d2b
