#include "detect/filled_share.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/row_bands.hpp"
#include "detect/bin_counts.hpp"
#include "detect/mask_runs.hpp"
#include "detect/smoothness.hpp"

namespace d2b {
namespace {

constexpr std::size_t bins = 1000;  // number of bins of HeightDifferences
constexpr float bin_m = 0.005F;
constexpr std::int64_t fewest = 300;
// Converts pairs to cells. A filled cell is equal to one neighbour, or to more if the neighbour was filled as
// well; there are two pairs per cell. Measured on simulated scans of 0.25 to 2 pulses per m^2, for which the
// filled cells are known.
constexpr double cells_a_pair = 1.6;

struct RoughCells {
    const MetreGrid& surface;
    const Mask& elevated;
    const Grid<std::uint8_t>& flags;

    /// @param row receives the rough cells, with one more element at the end
    void find(std::int32_t r, std::span<std::uint8_t> row) const {
        const std::uint8_t* const high = elevated.row(r).data();
        const std::uint8_t* const flag = flags.row(r).data();
        std::uint8_t* const out = row.data();
        constexpr int bit = std::countr_zero(std::uint8_t{smooth_enough});
        for (std::size_t c = 0; c + 1 < row.size(); ++c)
            out[c] = static_cast<std::uint8_t>(high[c] & ((flag[c] >> bit & 1) ^ 1));
        row.back() = 0;
    }
    void add_band(RowBand band, HeightDifferences& differences) const {
        const auto cols = static_cast<std::size_t>(surface.cols);
        std::vector<std::uint8_t> here(cols + 1);
        std::vector<std::uint8_t> below(cols + 1);
        find(band.begin, here);
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const std::int32_t next = std::min(r + 1, surface.rows - 1);
            if (next > r)
                find(next, below);
            else
                std::fill(below.begin(), below.end(), std::uint8_t{0});
            add_differences(surface.row(r), surface.row(next).data(), here, below, differences);
            here.swap(below);
        }
    }
};

}  // namespace

void add_difference(float difference, HeightDifferences& differences) {
    constexpr double half = 0.5;  // of a bin; rounds non-negative values without a function call
    if (!std::isnan(difference))
        differences.add(difference < bin_m * (bins - 1)
                            ? static_cast<std::size_t>(static_cast<double>(difference / bin_m) + half)
                            : bins);
}

void add_differences(std::span<const float> heights, const float* heights_below,
                     std::span<const std::uint8_t> here, std::span<const std::uint8_t> below,
                     HeightDifferences& differences) {
    const float* const z = heights.data();
    const auto cells = static_cast<std::int32_t>(heights.size());
    for_mask_runs(here, 1, [&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t c = begin; c < std::min(end, cells); ++c) {
            if (c + 1 < end)
                add_difference(std::abs(z[c] - z[c + 1]), differences);
            if (below[static_cast<std::size_t>(c)] != 0)
                add_difference(std::abs(z[c] - heights_below[c]), differences);
        }
    });
}

double filled_share(const HeightDifferences& differences) {
    // A non-zero difference occurs twice as often as 0 because its sign is ignored.
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
    const auto add_band = [&](RowBand band, HeightDifferences& some) { rough.add_band(band, some); };
    return filled_share(sum_of_row_bands(threads, surface.rows, surface.cols, HeightDifferences(), add_band));
}

}  // namespace d2b
