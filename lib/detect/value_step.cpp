#include "detect/value_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

constexpr std::size_t step_bins = StepCounts::bins;
constexpr std::int64_t fewest_differences = 100;
constexpr double frequent = 0.01;        // share of the differences
constexpr double nearly_all = 0.99;      // share of the differences
constexpr double least_step_m = 0.0009;  // a third of the multiples of a millimetre fall into bins by chance
constexpr double greatest_step_m = 3.1;  // 10 ft
constexpr double seen_as_rounding_m = 0.1;
constexpr double least_risers = 0.005;  // share of all pairs; Delft rounded down to 0.25 m has 0.025
constexpr double least_single = 0.2;    // share of the risers; Delft has 0.4, a block model 0.05

using Bins = std::array<StepCounts::Bin, step_bins>;

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
        StepCounts::Bin sum;
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

constexpr auto first_coarse = static_cast<std::size_t>(step_bins * StepCounts::fine_m / StepCounts::coarse_m);

std::size_t nearest_bin(double position) {
    return static_cast<std::size_t>(std::lround(position));
}

/// True if the surface rises in single steps, as a rounded surface does.
bool rises_in_steps(const StepCounts& counts, double step) {
    std::int64_t all = 0;
    std::int64_t single = 0;
    for (std::size_t i = 0; i < step_bins; ++i) {
        all += counts.risers[i];
        if (std::abs(static_cast<double>(i) * StepCounts::coarse_m - step) <= 1.01 * StepCounts::coarse_m)
            single += counts.risers[i];
    }
    return static_cast<double>(single) >= least_risers * static_cast<double>(counts.pairs) &&
           static_cast<double>(single) >= least_single * static_cast<double>(all);
}

}  // namespace

void StepCounts::add(std::span<const float> elevations) {
    constexpr float most_m = 10;
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    float before = none;
    float here = none;
    const auto look = [&](float after) {
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
        look(std::abs(elevations[i] - elevations[i - 1]));
    look(none);
}

void StepCounts::merge(const StepCounts& other) {
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

std::int32_t step_stride(std::int32_t rows, std::int32_t cols) {
    constexpr std::int64_t many = 1 << 21;
    return std::int64_t{rows} * cols > many ? 8 : 1;
}

std::optional<double> value_step(const StepCounts& counts) {
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
    const double fine_bins = *step / StepCounts::fine_m;
    const double within = std::clamp(std::round(0.03 * fine_bins), 1.0, 3.0);
    std::int64_t found = multiples(counts.fine, StepCounts::fine_m, 1, *step, within);
    std::int64_t all = pairs_in(counts.fine, 1, step_bins);
    if (*step > 4 * StepCounts::coarse_m) {  // otherwise every coarse bin is next to a multiple
        found += multiples(counts.coarse, StepCounts::coarse_m, first_coarse, *step, 1);
        all += pairs_in(counts.coarse, first_coarse, step_bins);
    }
    if (static_cast<double>(found) < nearly_all * static_cast<double>(all))
        return {};
    if (*step > seen_as_rounding_m * 0.99 && !rises_in_steps(counts, *step))
        return {};
    return step;
}

std::optional<double> value_step(const MetreGrid& surface, Executor& threads) {
    const std::int32_t stride = step_stride(surface.rows, surface.cols);
    return value_step(sum_of_row_bands(threads, surface.rows, surface.cols, StepCounts(),
                                       [&](RowBand band, StepCounts& some) {
                                           for (std::int32_t r = band.begin; r < band.end; ++r)
                                               if (r % stride == 0)
                                                   some.add(surface.row(r));
                                       }));
}

double neat_step(double step) {
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

}  // namespace d2b
