#pragma once

#include <cstdint>
#include <span>

#include "detect/bin_counts.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Histogram of height differences between neighbours in bins of 5 mm; the first bin counts equal pairs.
using HeightDifferences = BinCounts<1000>;
/// Adds one difference.
/// @param difference metres, not negative; NaN is ignored
void add_difference(float difference, HeightDifferences& differences);
/// Adds the differences of cells of a mask to the next cell in the row and to the cell below, if these belong
/// to the mask as well.
/// @param heights heights of a row, followed by one more if the mask continues
/// @param here, below mask of these cells and of one more behind them
void add_differences(std::span<const float> heights, const float* heights_below,
                     std::span<const std::uint8_t> here, std::span<const std::uint8_t> below,
                     HeightDifferences& differences);

/// Estimates the share of cells that no laser pulse hit and that were filled with the height of a neighbour,
/// as is common in survey products. It measures how sparse the points are. Only pairs of elevated cells on
/// rough surfaces (crowns and clutter) count, because there two neighbours are equal by chance no more often
/// than they differ by any other small number. Returns 0 if there are too few pairs, or if heights are
/// rounded, because equal heights are then no evidence. Integer sums, so the order does not matter.
/// @param flags result of smoothness()
[[nodiscard]] double filled_share(const MetreGrid& surface, const Mask& elevated,
                                  const Grid<std::uint8_t>& flags, Executor& threads);
/// Same, from the histogram of these pairs.
[[nodiscard]] double filled_share(const HeightDifferences& differences);

}  // namespace d2b
