#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace d2b {

/// Red, green and blue.
using Colour = std::array<std::uint8_t, 3>;

/// What is seen of a colour below another one. @param opacity of the upper one
[[nodiscard]] inline Colour covered(Colour lower, Colour upper, double opacity) {
    Colour seen{};
    for (std::size_t i = 0; i < seen.size(); ++i)
        seen[i] = static_cast<std::uint8_t>(std::lround(lower[i] * (1 - opacity) + upper[i] * opacity));
    return seen;
}

inline constexpr Colour paper{255, 255, 255};
inline constexpr Colour ink{35, 35, 35};
inline constexpr Colour faint_ink{95, 95, 95};
/// Of outlines and frames.
inline constexpr Colour edge{70, 45, 35};
/// Of level ground in the relief.
inline constexpr Colour level_ground{222, 222, 222};
/// How much of the relief footprints hide.
inline constexpr double footprint_opacity = 0.82;

}  // namespace d2b
