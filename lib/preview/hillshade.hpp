#pragma once

#include <cstdint>

namespace d2b {

/// Colour of cells without elevation: white. Pixels are 0xRRGGBB.
inline constexpr std::uint32_t open_ground = 0xFFFFFF;

/// Lambertian hillshade with light from the upper left, 45 degrees above the horizon. Slopes are compressed
/// to less than 0.8, because walls and trees would otherwise be black; gentle slopes are almost unchanged.
/// @param right, down slope (rise over run) in that direction @return a pixel
[[nodiscard]] std::uint32_t shade_of(double right, double down);

}  // namespace d2b
