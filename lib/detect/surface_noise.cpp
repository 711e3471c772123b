#include "detect/surface_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/row_bands.hpp"
#include "detect/bin_counts.hpp"

namespace d2b {
namespace {

constexpr std::size_t bend_bins = 2000;
constexpr float bend_bin_m = 0.001F;
constexpr std::int64_t fewest_bends = 1000;
// Quantiles of the absolute second differences between which the mean is taken. Gardens, kerbs and cars on
// open ground cause larger ones, and dominate on coarse cells.
constexpr double lower_share = 0.1;
constexpr double upper_share = 0.2;
// Mean of these differences for normal noise with a standard deviation of 1. The second difference of noise
// is sqrt(1 + 4 + 1) times as wide; with f the density of a normal distribution, and 0.12566 and 0.25335 the
// bounds within which a tenth and a fifth of it lie, their mean is 2 (f(0.12566) - f(0.25335)) / (0.2 - 0.1).
const double mean_of_unit_noise = 0.18925 * std::sqrt(6.0);

using Bends = BinCounts<bend_bins>;

void add_row(std::span<const float> z, std::span<const std::uint8_t> high, Bends& bends) {
    for (std::size_t c = 1; c + 1 < z.size(); ++c) {
        const float bend = std::abs(z[c - 1] + z[c + 1] - 2 * z[c]);
        if (high[c - 1] + high[c] + high[c + 1] != 0 || std::isnan(bend))
            continue;
        bends.add(bend < bend_bin_m * bend_bins ? static_cast<std::size_t>(bend / bend_bin_m) : bend_bins);
    }
}

/// Returns the sum of the `many` smallest values in m. Values are assumed to be spread evenly within a bin.
double sum_of_smallest(const Bends& bends, double many) {
    double sum = 0;
    for (std::size_t bin = 0; many > 0 && bin <= bend_bins; ++bin) {
        const auto here = static_cast<double>(bends.counts[bin]);
        const double taken = std::min(many, here);
        sum += taken * (static_cast<double>(bin) + (taken > 0 ? taken / here / 2 : 0));
        many -= taken;
    }
    return sum * static_cast<double>(bend_bin_m);
}

}  // namespace

double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads) {
    const auto add_band = [&](RowBand band, Bends& some) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            add_row(surface.row(r), elevated.row(r), some);
    };
    const Bends sum = sum_of_row_bands(threads, surface.rows, surface.cols, Bends(), add_band);
    const auto all = static_cast<double>(sum.all);
    // Repeated and rounded values fall into the first bin.
    if (sum.all < fewest_bends || static_cast<double>(sum.counts[0]) >= upper_share * all)
        return 0;
    const double between = sum_of_smallest(sum, upper_share * all) - sum_of_smallest(sum, lower_share * all);
    return between / ((upper_share - lower_share) * all) / mean_of_unit_noise;
}

}  // namespace d2b
