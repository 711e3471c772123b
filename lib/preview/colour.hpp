#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace d2b {

/// RGB, 8 bits per channel.
using Colour = std::array<std::uint8_t, 3>;

/// Blends two colours. @param opacity of the upper one
[[nodiscard]] inline Colour covered(Colour lower, Colour upper, double opacity) {
    Colour seen{};
    for (std::size_t i = 0; i < seen.size(); ++i)
        seen[i] = static_cast<std::uint8_t>(std::lround(lower[i] * (1 - opacity) + upper[i] * opacity));
    return seen;
}

inline constexpr Colour paper{255, 255, 255};
inline constexpr Colour ink{35, 35, 35};
inline constexpr Colour faint_ink{95, 95, 95};
/// Colour of outlines and frames.
inline constexpr Colour edge{70, 45, 35};
/// Colour of level ground in the relief.
inline constexpr Colour level_ground{222, 222, 222};
/// Opacity of footprints over the relief.
inline constexpr double footprint_opacity = 0.82;

}  // namespace d2b
