#pragma once

#include <algorithm>

#include "detect/scene.hpp"

namespace d2b {

/// Metres by which neighbouring cells differ where a wall stands between them: more than roofs rise, which is
/// 63 degrees in cells of 0.5 m and 56 in those of a metre and more.
[[nodiscard]] inline float roof_step(const Scene& scene) {
    constexpr double least = 1;
    constexpr double slope = 1.5;
    return static_cast<float>(std::max(least, slope * scene.side()));
}

}  // namespace d2b
