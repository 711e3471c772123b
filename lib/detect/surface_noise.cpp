#include "detect/surface_noise.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <span>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

constexpr std::size_t bins = 2000;
constexpr float bin_m = 0.001F;
constexpr std::int64_t fewest = 1000;
// The second difference of noise is sqrt(1 + 4 + 1) times as wide, and half of a normal distribution lies
// within 0.6745 standard deviations.
const double median_of_unit_noise = 0.67449 * std::sqrt(6.0);

struct Counts {
    std::array<std::int64_t, bins + 1> counts{};
    std::int64_t all = 0;

    void add_row(std::span<const float> z, std::span<const std::uint8_t> high) {
        for (std::size_t c = 1; c + 1 < z.size(); ++c) {
            const float bend = std::abs(z[c - 1] + z[c + 1] - 2 * z[c]);
            if (high[c - 1] + high[c] + high[c + 1] != 0 || std::isnan(bend))
                continue;
            ++all;
            ++counts[bend < bin_m * bins ? static_cast<std::size_t>(bend / bin_m) : bins];
        }
    }
    void add(const Counts& other) {
        all += other.all;
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] += other.counts[i];
    }
};

}  // namespace

double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads) {
    Counts sum;
    std::mutex mutex;
    for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
        Counts some;
        for (std::int32_t r = band.begin; r < band.end; ++r)
            some.add_row(surface.row(r), elevated.row(r));
        const std::lock_guard lock(mutex);
        sum.add(some);
    });
    const auto& [counts, all] = sum;
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
