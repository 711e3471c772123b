#pragma once

#include <algorithm>

#include "detect/scene.hpp"

namespace d2b {

/// Height difference in m between neighbouring cells that are separated by a wall. It is more than roofs
/// rise: 63 degrees in cells of 0.5 m, 56 degrees in cells of a metre and more.
[[nodiscard]] inline float roof_step(const Scene& scene) {
    constexpr double least = 1;
    constexpr double slope = 1.5;
    return static_cast<float>(std::max(least, slope * scene.side()));
}

}  // namespace d2b
