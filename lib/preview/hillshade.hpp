#pragma once

#include <cstdint>

namespace d2b {

/// Where there is no elevation: white. Pixels are red, green and blue, from the high byte to the low.
inline constexpr std::uint32_t open_ground = 0xFFFFFF;

/// Slopes to the right and downwards; light from the upper left, 45 degrees high. Walls and trees are not
/// black: however steep, a slope counts as less than 0.8, and gentle ones nearly as they are.
/// @param right, down rise over run @return a pixel
[[nodiscard]] std::uint32_t shade_of(double right, double down);

}  // namespace d2b
