#include "detect/surface_quality.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "detect/smoothness.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {
namespace {

constexpr std::size_t step_bins = StepHistogram::bins;
constexpr std::int64_t fewest_differences = 100;
constexpr double frequent = 0.01;        // share of the differences
constexpr double nearly_all = 0.99;      // share of the differences
constexpr double more_than_half = 0.5;   // the same for steps of a decimetre and more
constexpr double least_step_m = 0.0009;  // a third of the multiples of a millimetre fall into bins by chance
constexpr double greatest_step_m = 3.1;  // 10 ft
constexpr double seen_as_rounding_m = 0.1;
constexpr double least_risers = 0.005;  // share of all pairs; Delft rounded down to 0.25 m has 0.025
constexpr double least_single = 0.2;    // share of the risers; Delft has 0.4, a block model 0.05

using Bins = std::array<StepHistogram::Bin, step_bins>;

std::int64_t pairs_in(const Bins& counts, std::size_t first, std::size_t end) {
    std::int64_t pairs = 0;
    for (std::size_t i = first; i < std::min(end, step_bins); ++i)
        pairs += counts[i].pairs;
    return pairs;
}

/// Returns the mean in m of the smallest frequent differences; nullopt if there are none.
/// @param width number of bins over which differences of one size may spread
std::optional<double> first_peak(const Bins& counts, std::size_t first, std::size_t width, double least) {
    for (std::size_t i = first; i < step_bins; ++i) {
        if (counts[i].pairs == 0 || static_cast<double>(pairs_in(counts, i, i + width)) < least)
            continue;
        StepHistogram::Bin sum;
        for (std::size_t k = i; k < std::min(i + width, step_bins); ++k) {
            sum.pairs += counts[k].pairs;
            sum.micrometres += counts[k].micrometres;
        }
        return static_cast<double>(sum.micrometres) / static_cast<double>(sum.pairs) * 1e-6;
    }
    return {};
}

/// Counts differences that are multiples of a step.
/// @param within tolerance in bins
std::int64_t multiples(const Bins& counts, double size_m, std::size_t first, double step, double within) {
    std::int64_t pairs = 0;
    for (std::size_t i = first; i < step_bins; ++i) {
        const double size = static_cast<double>(i) * size_m;
        const double nearest = std::round(size / step) * step;
        if (nearest > 0 && std::abs(size - nearest) <= (within + 0.01) * size_m)
            pairs += counts[i].pairs;
    }
    return pairs;
}

constexpr auto first_coarse =
    static_cast<std::size_t>(step_bins * StepHistogram::fine_m / StepHistogram::coarse_m);

std::size_t nearest_bin(double position) {
    return static_cast<std::size_t>(std::lround(position));
}

/// True if the surface rises in single steps, as a rounded surface does.
bool rises_in_steps(const StepHistogram& counts, double step) {
    std::int64_t all = 0;
    std::int64_t single = 0;
    for (std::size_t i = 0; i < step_bins; ++i) {
        all += counts.risers[i];
        if (std::abs(static_cast<double>(i) * StepHistogram::coarse_m - step) <=
            1.01 * StepHistogram::coarse_m)
            single += counts.risers[i];
    }
    return static_cast<double>(single) >= least_risers * static_cast<double>(counts.pairs) &&
           static_cast<double>(single) >= least_single * static_cast<double>(all);
}

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

using Bends = Histogram<bend_bins>;

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

constexpr std::size_t difference_bins = 1000;  // number of bins of HeightDifferences
constexpr float difference_bin_m = 0.005F;
constexpr std::int64_t fewest_pairs = 300;
// Converts pairs to cells. A filled cell is equal to one neighbour, or to more if the neighbour was filled as
// well; there are two pairs per cell. Measured on simulated scans of 0.25 to 2 pulses per m^2, for which the
// filled cells are known.
constexpr double cells_a_pair = 1.6;

/// Adds the differences between the cells of a mask in a row and their neighbours to the right and below.
/// @param here, below mask of these cells and of one more behind them
void add_differences(const float* z, const float* z_below, std::span<const std::uint8_t> here,
                     std::span<const std::uint8_t> below, HeightDifferences& differences) {
    const auto cells = static_cast<std::int32_t>(here.size()) - 1;
    for_mask_runs(here, 1, [&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t c = begin; c < std::min(end, cells); ++c) {
            if (c + 1 < end)
                add_difference(std::abs(z[c] - z[c + 1]), differences);
            if (below[static_cast<std::size_t>(c)] != 0)
                add_difference(std::abs(z[c] - z_below[c]), differences);
        }
    });
}

}  // namespace

void StepHistogram::add(std::span<const float> elevations) {
    constexpr float most_m = 10;
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    float before = none;
    float here = none;
    const auto visit = [&](float after) {
        if (here < most_m) {  // false for NaN
            ++pairs;
            const auto size = static_cast<double>(here);
            const auto small = nearest_bin(size / fine_m);
            if (small == 0)
                ++equal;
            Bin& bin = small < step_bins ? fine[small]
                                         : coarse[std::min(nearest_bin(size / coarse_m), step_bins - 1)];
            ++bin.pairs;
            bin.micrometres += std::llround(size * 1e6);
            if (here > 0 && before == 0 && after == 0)
                ++risers[std::min(nearest_bin(size / coarse_m), step_bins - 1)];
        }
        before = here;
        here = after;
    };
    for (std::size_t i = 1; i < elevations.size(); ++i)
        visit(std::abs(elevations[i] - elevations[i - 1]));
    visit(none);
}

void StepHistogram::merge(const StepHistogram& other) {
    pairs += other.pairs;
    equal += other.equal;
    for (std::size_t i = 0; i < step_bins; ++i) {
        fine[i].pairs += other.fine[i].pairs;
        fine[i].micrometres += other.fine[i].micrometres;
        coarse[i].pairs += other.coarse[i].pairs;
        coarse[i].micrometres += other.coarse[i].micrometres;
        risers[i] += other.risers[i];
    }
}

std::int32_t sampled_row_stride(std::int32_t rows, std::int32_t cols) {
    constexpr std::int64_t many = 1 << 21;
    return std::int64_t{rows} * cols > many ? 8 : 1;
}

std::optional<double> value_step(const StepHistogram& counts) {
    const std::int64_t differing = counts.pairs - counts.equal;
    if (differing < fewest_differences)
        return {};
    const double least = frequent * static_cast<double>(differing);
    constexpr std::size_t fine_width = 7;
    constexpr std::size_t coarse_width = 2;
    std::optional<double> step = first_peak(counts.fine, 1, fine_width, least);
    if (!step)
        step = first_peak(counts.coarse, first_coarse, coarse_width, least);
    if (!step || *step < least_step_m || *step > greatest_step_m)
        return {};
    const double fine_bins = *step / StepHistogram::fine_m;
    const double within = std::clamp(std::round(0.03 * fine_bins), 1.0, 3.0);
    std::int64_t found = multiples(counts.fine, StepHistogram::fine_m, 1, *step, within);
    std::int64_t all = pairs_in(counts.fine, 1, step_bins);
    if (*step > 4 * StepHistogram::coarse_m) {  // otherwise every coarse bin is next to a multiple
        found += multiples(counts.coarse, StepHistogram::coarse_m, first_coarse, *step, 1);
        all += pairs_in(counts.coarse, first_coarse, step_bins);
    }
    // Some cells of rounded rasters were interpolated later. At most 15 % of other differences are multiples
    // of a decimetre by chance, and fewer of larger steps.
    const bool is_large = *step > seen_as_rounding_m * 0.99;
    if (static_cast<double>(found) < (is_large ? more_than_half : nearly_all) * static_cast<double>(all) ||
        (is_large && !rises_in_steps(counts, *step)))
        return {};
    return step;
}

std::optional<double> value_step(const MetreGrid& surface, Executor& threads) {
    const std::int32_t stride = sampled_row_stride(surface.rows, surface.cols);
    return value_step(reduce_rows(threads, surface.rows, surface.cols, StepHistogram(),
                                  [&](std::int32_t r, StepHistogram& some) {
                                      if (r % stride == 0)
                                          some.add(surface.row(r));
                                  }));
}

double nearest_round_step(double step) {
    constexpr double tolerance = 0.001;
    constexpr double digits = 1e5;
    const double power = std::pow(10, std::floor(std::log10(step) + tolerance));
    for (const double factor : {1.0, 2.0, 2.5, 5.0})
        if (std::abs(step / power - factor) < tolerance * factor)
            return power < 1 ? factor / std::round(1 / power) : factor * power;
    return power < 1 ? std::round(step * std::round(1 / power) * digits) / (digits * std::round(1 / power))
                     : std::round(step / power * digits) / digits * power;
}

double rounding_noise(double step) {
    return step / std::sqrt(12.0);
}

double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads) {
    const Bends sum =
        reduce_rows(threads, surface.rows, surface.cols, Bends(),
                    [&](std::int32_t r, Bends& some) { add_row(surface.row(r), elevated.row(r), some); });
    const auto all = static_cast<double>(sum.all);
    // Repeated and rounded values fall into the first bin.
    if (sum.all < fewest_bends || static_cast<double>(sum.counts[0]) >= upper_share * all)
        return 0;
    const double between = sum_of_smallest(sum, upper_share * all) - sum_of_smallest(sum, lower_share * all);
    return between / ((upper_share - lower_share) * all) / mean_of_unit_noise;
}

void add_difference(float difference, HeightDifferences& differences) {
    constexpr double half = 0.5;  // of a bin; rounds non-negative values without a function call
    if (!std::isnan(difference))
        differences.add(
            difference < difference_bin_m * (difference_bins - 1)
                ? static_cast<std::size_t>(static_cast<double>(difference / difference_bin_m) + half)
                : difference_bins);
}

HeightDifferences rough_differences(const MetreGrid& surface, const Mask& elevated,
                                    const Grid<std::uint8_t>& flags, const Window& own, Executor& threads) {
    const std::int32_t known = std::min(own.cols + 1, surface.cols - own.col);
    const auto find = [&](std::int32_t r, std::span<std::uint8_t> row) {
        std::ranges::fill(row, std::uint8_t{0});
        if (r >= surface.rows)
            return;
        const std::uint8_t* const high = elevated.row(r).data() + own.col;
        const std::uint8_t* const flag = flags.row(r).data() + own.col;
        std::uint8_t* const out = row.data();
        constexpr int bit = std::countr_zero(std::uint8_t{smooth_enough});
        for (std::int32_t c = 0; c < known; ++c)
            out[c] = static_cast<std::uint8_t>(high[c] & ((flag[c] >> bit & 1) ^ 1));
    };
    const auto add_band = [&](RowBand band, HeightDifferences& differences) {
        std::vector<std::uint8_t> here(static_cast<std::size_t>(own.cols) + 1);
        std::vector<std::uint8_t> below(here.size());
        find(own.row + band.begin, here);
        for (std::int32_t r = own.row + band.begin; r < own.row + band.end; ++r) {
            find(r + 1, below);
            add_differences(surface.row(r).data() + own.col,
                            surface.row(std::min(r + 1, surface.rows - 1)).data() + own.col, here, below,
                            differences);
            here.swap(below);
        }
    };
    return reduce_row_bands(threads, own.rows, own.cols, HeightDifferences(), add_band);
}

double interpolated_fraction(const HeightDifferences& differences) {
    // A non-zero difference occurs twice as often as 0 because its sign is ignored.
    const std::int64_t by_chance =
        *std::max_element(differences.counts.begin() + 1, differences.counts.end() - 1) / 2;
    const std::int64_t equal = differences.counts[0];
    if (differences.all < fewest_pairs || equal < 2 * by_chance)
        return 0;
    return std::min(
        1.0, cells_a_pair * static_cast<double>(equal - by_chance) / static_cast<double>(differences.all));
}

double interpolated_fraction(const MetreGrid& surface, const Mask& elevated, const Grid<std::uint8_t>& flags,
                             Executor& threads) {
    return interpolated_fraction(
        rough_differences(surface, elevated, flags, {0, 0, surface.rows, surface.cols}, threads));
}

}  // namespace d2b::detect
