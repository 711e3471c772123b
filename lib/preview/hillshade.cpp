#include "preview/hillshade.hpp"

#include <algorithm>
#include <cmath>

#include "preview/colour.hpp"

namespace d2b {

std::uint32_t shade_of(double right, double down) {
    constexpr double dark = 130;
    constexpr double flat = level_ground[0];
    constexpr double bright = 250;
    constexpr double steepest = 0.8;
    constexpr double brightest = 1.7320508075688772;  // relative to level ground
    const double less = steepest / (steepest + std::hypot(right, down));
    right *= less;
    down *= less;
    const double light = (1 + right + down) / std::sqrt(1 + right * right + down * down);
    const double grey = light < 1 ? dark + (flat - dark) * std::max(light, 0.0)
                                  : flat + (bright - flat) * (light - 1) / (brightest - 1);
    const auto level = static_cast<std::uint32_t>(std::lround(std::clamp(grey, dark, bright)));
    return level << 16U | level << 8U | level;
}

}  // namespace d2b
