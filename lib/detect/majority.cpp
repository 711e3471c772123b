#include "detect/majority.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "core/processors.hpp"
#include "core/row_bands.hpp"

namespace d2b {
namespace {

/// Thresholds in per cent: a cell joins if buildings cover more than `gain` of its neighbourhood, and a
/// building cell stays if they cover more than `keep`.
struct Shares {
    std::int64_t gain;
    std::int64_t keep;
};

/// Half sides of a neighbourhood in cells.
struct Radius {
    std::int32_t up;
    std::int32_t side;
};

constexpr double growth_reach_m = 3.5;
constexpr Shares growth_shares{58, 10};
constexpr int growth_rounds = 2;
constexpr double border_reach_m = 1;
constexpr Shares border_shares{50, 50};

std::int32_t reach(double reach_m, double step, std::int32_t cells) {
    const double reached = std::round(reach_m / step);
    return std::max(1, static_cast<std::int32_t>(std::min(reached, static_cast<double>(cells))));
}

/// Counts two kinds of cells in a sliding window by column sums, which are then added up along the row. Both
/// counts are packed into one integer (building cells in the upper half), because that halves the work.
/// Unsigned integers wrap around, so intermediate overflow is harmless.
template <typename Pair>
class NeighbourCounts {
  public:
    static constexpr int half = std::numeric_limits<Pair>::digits / 2;

    /// @param elevated null: all cells count
    /// @param first first row that will be requested
    NeighbourCounts(const Mask& buildings, const Mask* elevated, std::int32_t up, std::int32_t side,
                    std::int32_t first)
        : buildings_(buildings),
          elevated_(elevated),
          up_(up),
          side_(static_cast<std::size_t>(side)),
          // Padded by zeros at both ends.
          columns_(static_cast<std::size_t>(buildings.cols) + 2 * side_, 0),
          none_(static_cast<std::size_t>(buildings.cols), 0) {
        if (elevated == nullptr)
            for (std::int32_t c = 0; c < buildings.cols; ++c)
                widths_.push_back(
                    static_cast<Pair>(std::min(c + side, buildings.cols - 1) - std::max(c - side, 0) + 1));
        for (std::int32_t r = std::max(first - up - 1, 0); r < first + up; ++r)
            slide(r, -1);
    }
    /// @param counts receives the counts of row `r`, which must follow the last requested row
    void row(std::int32_t r, std::vector<Pair>& counts) {
        slide(r + up_, r - up_ - 1);
        add_up(counts);
        if (elevated_ == nullptr) {
            const auto rows =
                static_cast<Pair>(std::min(r + up_, buildings_.rows - 1) - std::max(r - up_, 0) + 1);
            for (std::size_t c = 0; c < counts.size(); ++c)
                counts[c] = static_cast<Pair>(counts[c] + rows * widths_[c]);
        }
    }

  private:
    /// Adds up 2 side + 1 columns from sums over 1, 2, 4, ... columns. A running sum takes fewer steps, but
    /// each depends on the one before and cannot be vectorised.
    void add_up(std::vector<Pair>& counts) {
        const std::size_t width = 2 * side_ + 1;
        sums_.assign(columns_.begin(), columns_.end());
        std::fill(counts.begin(), counts.end(), Pair{0});
        std::size_t taken = 0;
        for (std::size_t span = 1; span <= width; span *= 2) {
            if ((width & span) != 0) {
                for (std::size_t c = 0; c < counts.size(); ++c)
                    counts[c] = static_cast<Pair>(counts[c] + sums_[c + taken]);
                taken += span;
            }
            for (std::size_t c = 0; c + span < sums_.size(); ++c)
                sums_[c] = static_cast<Pair>(sums_[c] + sums_[c + span]);
        }
    }
    [[nodiscard]] std::span<const std::uint8_t> row_of(const Mask& mask, std::int32_t r) const {
        return r >= 0 && r < mask.rows ? mask.row(r) : none_;
    }
    /// Adds one row to the window and removes another.
    void slide(std::int32_t in, std::int32_t out) {
        const std::span<const std::uint8_t> buildings_in = row_of(buildings_, in);
        const std::span<const std::uint8_t> buildings_out = row_of(buildings_, out);
        Pair* const columns = columns_.data() + side_;
        if (elevated_ == nullptr) {
            for (std::size_t c = 0; c < buildings_in.size(); ++c)
                columns[c] = static_cast<Pair>(columns[c] +
                                               ((Pair{buildings_in[c]} - Pair{buildings_out[c]}) << half));
            return;
        }
        const std::span<const std::uint8_t> elevated_in = row_of(*elevated_, in);
        const std::span<const std::uint8_t> elevated_out = row_of(*elevated_, out);
        for (std::size_t c = 0; c < buildings_in.size(); ++c)
            columns[c] =
                static_cast<Pair>(columns[c] + ((Pair{buildings_in[c]} - Pair{buildings_out[c]}) << half) +
                                  elevated_in[c] - elevated_out[c]);
    }

    const Mask& buildings_;
    const Mask* elevated_;
    std::int32_t up_;
    std::size_t side_;
    std::vector<Pair> columns_;
    std::vector<Pair> sums_;  ///< scratch of add_up()
    std::vector<std::uint8_t> none_;
    std::vector<Pair> widths_;  ///< width of each neighbourhood, if all cells count
};

/// Cells that vote, and cells that may become building.
struct Electorate {
    const Mask* elevated;  ///< cells that vote; null: all
    const Mask& may;
};

template <typename Pair>
void vote(const Mask& now, const Electorate& of, Radius radius, Shares shares, RowBand band, Mask& next) {
    NeighbourCounts<Pair> neighbours(now, of.elevated, radius.up, radius.side, band.begin);
    std::vector<Pair> counts(static_cast<std::size_t>(now.cols));
    for (std::int32_t r = band.begin; r < band.end; ++r) {
        neighbours.row(r, counts);
        const std::span<const std::uint8_t> is = now.row(r);
        const std::span<const std::uint8_t> may = of.may.row(r);
        const std::span<std::uint8_t> out = next.row(r);
        // A hundred times the largest count fits into the signed type. Branch-free, so that the loop
        // vectorises.
        using Signed = std::make_signed_t<Pair>;
        const auto keep = static_cast<Signed>(shares.keep);
        const auto gain = static_cast<Signed>(shares.gain);
        for (std::size_t c = 0; c < out.size(); ++c) {
            const auto buildings = static_cast<Signed>(counts[c] >> NeighbourCounts<Pair>::half);
            const auto all = static_cast<Signed>(
                counts[c] & (std::numeric_limits<Pair>::max() >> NeighbourCounts<Pair>::half));
            const Signed share = is[c] != 0 ? keep : gain;
            const bool won = static_cast<Signed>(100 * buildings) > static_cast<Signed>(share * all);
            out[c] = static_cast<std::uint8_t>(may[c] & (won ? 1 : 0));
        }
    }
}

D2B_FOR_EACH_PROCESSOR void small_vote(const Mask& now, const Electorate& of, Radius radius, Shares shares,
                                       RowBand band, Mask& next) {
    vote<std::uint16_t>(now, of, radius, shares, band, next);
}

D2B_FOR_EACH_PROCESSOR void large_vote(const Mask& now, const Electorate& of, Radius radius, Shares shares,
                                       RowBand band, Mask& next) {
    vote<std::uint32_t>(now, of, radius, shares, band, next);
}

/// Selects the smallest integer type that holds the counts.
/// @param cells number of cells of the largest neighbourhood
auto vote_among(std::int64_t cells) {
    if (cells <= std::numeric_limits<std::uint8_t>::max())
        return small_vote;
    return cells <= std::numeric_limits<std::uint16_t>::max() ? large_vote : vote<std::uint64_t>;
}

Mask voted(const Mask& now, const Electorate& of, double reach_m, const CellSize& cell, Shares shares,
           Executor& threads) {
    const Radius radius{reach(reach_m, cell.down, now.rows), reach(reach_m, cell.across, now.cols)};
    const std::int64_t largest = (2 * std::int64_t{radius.up} + 1) * (2 * std::int64_t{radius.side} + 1);
    const auto vote_in = vote_among(largest);
    Mask next = Mask::unset(now.rows, now.cols, threads);
    // Bands have a minimum height, because each begins by summing up its first neighbourhood.
    const std::int32_t least = 8 * std::min(radius.up, now.rows);
    for_row_bands(
        threads, now.rows, now.cols, [&](RowBand band) { vote_in(now, of, radius, shares, band, next); },
        std::max(least, 16));
    return next;
}

}  // namespace

Mask grow_by_majority(Mask seeds, const Mask& elevated, const CellSize& cell, Executor& threads) {
    for (int i = 0; i < growth_rounds; ++i)
        seeds = voted(seeds, {&elevated, elevated}, growth_reach_m, cell, growth_shares, threads);
    return seeds;
}

Mask smooth_border(const Mask& mask, const Mask& within, const CellSize& cell, Executor& threads) {
    return voted(mask, {nullptr, within}, border_reach_m, cell, border_shares, threads);
}

}  // namespace d2b
