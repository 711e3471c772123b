#include "detect/filled_share.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/row_bands.hpp"
#include "detect/bin_counts.hpp"
#include "detect/smoothness.hpp"

namespace d2b {
namespace {

constexpr std::size_t bins = 1000;  // of HeightDifferences
constexpr float bin_m = 0.005F;
constexpr std::int64_t fewest = 300;
// A filled cell is equal to one neighbour, where two were filled from one to more; of two pairs a cell.
// Measured on simulated scans of 0.25 to 2 pulses a square metre, where it is known which cells were filled.
constexpr double cells_a_pair = 1.6;

struct RoughCells {
    const MetreGrid& surface;
    const Mask& elevated;
    const Grid<std::uint8_t>& flags;

    [[nodiscard]] bool holds(std::size_t i) const {
        return elevated.values[i] != 0 && (flags.values[i] & smooth_enough) == 0;
    }
    /// A row's pairs with the next cell, and with the cell below.
    void add_row(std::int32_t r, HeightDifferences& differences) const {
        const auto cols = static_cast<std::size_t>(surface.cols);
        const std::size_t first = surface.index(r, 0);
        const bool has_below = r + 1 < surface.rows;
        for (std::size_t i = first; i < first + cols; ++i) {
            if (!holds(i))
                continue;
            if (i + 1 < first + cols && holds(i + 1))
                add_difference(std::abs(surface.values[i] - surface.values[i + 1]), differences);
            if (has_below && holds(i + cols))
                add_difference(std::abs(surface.values[i] - surface.values[i + cols]), differences);
        }
    }
};

}  // namespace

void add_difference(float difference, HeightDifferences& differences) {
    constexpr double half = 0.5;  // of a bin: what is not negative is rounded without a call
    if (!std::isnan(difference))
        differences.add(difference < bin_m * (bins - 1)
                            ? static_cast<std::size_t>(static_cast<double>(difference / bin_m) + half)
                            : bins);
}

double filled_share(const HeightDifferences& differences) {
    // Up and down count as one, so that a difference is found twice as often as none.
    const std::int64_t by_chance =
        *std::max_element(differences.counts.begin() + 1, differences.counts.end() - 1) / 2;
    const std::int64_t equal = differences.counts[0];
    if (differences.all < fewest || equal < 2 * by_chance)
        return 0;
    return std::min(
        1.0, cells_a_pair * static_cast<double>(equal - by_chance) / static_cast<double>(differences.all));
}

double filled_share(const MetreGrid& surface, const Mask& elevated, const Grid<std::uint8_t>& flags,
                    Executor& threads) {
    const RoughCells rough{surface, elevated, flags};
    const auto add_band = [&](RowBand band, HeightDifferences& some) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            rough.add_row(r, some);
    };
    return filled_share(sum_of_row_bands(threads, surface.rows, surface.cols, HeightDifferences(), add_band));
}

}  // namespace d2b
