#pragma once

#include <cstdint>
#include <span>

#include "detect/bin_counts.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// How many pairs of neighbours differ by how much, in bins of 5 mm; the first counts what is equal.
using HeightDifferences = BinCounts<1000>;
/// @param difference metres, not negative; NaN does not count
void add_difference(float difference, HeightDifferences& differences);
/// Those of cells of a mask to the next one in the row and to the one below, where these are of it as well.
/// @param heights of so many cells of a row, and of the cell behind them if the mask has it
/// @param here, below the mask of these cells and of one more behind them
void add_differences(std::span<const float> heights, const float* heights_below,
                     std::span<const std::uint8_t> here, std::span<const std::uint8_t> below,
                     HeightDifferences& differences);

/// The share of the cells that no pulse met and that were given the height of a neighbour, as surveys do:
/// what tells how thin the points are. It is seen where the surface is rough, on crowns and clutter: there
/// two neighbours are equal by chance no more often than they differ by any other small number. Pairs of
/// neighbours are counted whose cells are elevated and bend whichever way one looks. 0 where there are too
/// few of them, and where heights are rounded, so that equal ones say nothing. Sums in whole numbers: their
/// order does not matter.
/// @param flags of smoothness()
[[nodiscard]] double filled_share(const MetreGrid& surface, const Mask& elevated,
                                  const Grid<std::uint8_t>& flags, Executor& threads);
/// The same from the differences of such pairs.
[[nodiscard]] double filled_share(const HeightDifferences& differences);

}  // namespace d2b
