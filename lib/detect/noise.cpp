#include "detect/noise.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace d2b {
namespace {

constexpr std::size_t bins = 2000;
constexpr float bin_m = 0.001F;
constexpr std::int64_t fewest = 1000;
// The second difference of noise is sqrt(1 + 4 + 1) times as wide, and half of a normal distribution lies
// within 0.6745 standard deviations.
const double median_of_unit_noise = 0.67449 * std::sqrt(6.0);

}  // namespace

double estimate_noise(const MetreGrid& surface, const Mask& elevated) {
    std::array<std::int64_t, bins + 1> counts{};
    std::int64_t all = 0;
    for (std::int32_t r = 0; r < surface.rows; ++r) {
        const std::span<const float> z = surface.row(r);
        const std::span<const std::uint8_t> high = elevated.row(r);
        for (std::size_t c = 1; c + 1 < z.size(); ++c) {
            const float bend = std::abs(z[c - 1] + z[c + 1] - 2 * z[c]);
            if (high[c - 1] + high[c] + high[c + 1] != 0 || std::isnan(bend))
                continue;
            ++all;
            ++counts[bend < bin_m * bins ? static_cast<std::size_t>(bend / bin_m) : bins];
        }
    }
    if (all < fewest)
        return 0;
    std::int64_t below = 0;
    std::size_t bin = 0;
    while (2 * (below + counts[bin]) < all)
        below += counts[bin++];
    // Within the median's bin values are taken as evenly spread; the first holds what is repeated or rounded.
    const double share =
        (static_cast<double>(all) / 2 - static_cast<double>(below)) / static_cast<double>(counts[bin]);
    return bin == 0 ? 0
                    : (static_cast<double>(bin) + share) * static_cast<double>(bin_m) / median_of_unit_noise;
}

}  // namespace d2b
