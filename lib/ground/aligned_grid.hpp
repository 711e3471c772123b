#pragma once

#include <cstdint>

#include "core/grid.hpp"

namespace d2b::ground {

/// A grid that knows where its first cell lies on the grid of the whole raster at the same cell size. Blocks
/// of cells are cut on that grid, so that any window of a raster is cut as the whole raster is.
struct AlignedGrid {
    MetreGrid grid;
    std::int32_t first_row = 0;
    std::int32_t first_col = 0;
    CellSize cell;
};

/// How many cells make a block.
struct Factor {
    std::int32_t down = 1;
    std::int32_t across = 1;
};
inline constexpr Factor twice{2, 2};  ///< from a level of a pyramid to the next

/// The block that holds a cell; cells before the raster's first have negative numbers.
[[nodiscard]] constexpr std::int32_t block_of(std::int32_t cell, std::int32_t factor) {
    return cell >= 0 ? cell / factor : -((-cell + factor - 1) / factor);
}

/// The factor that turns cells of this size into blocks of about `wanted` metres.
[[nodiscard]] Factor factor_for(const CellSize& cell, double wanted);

/// An empty grid of the blocks that cover `fine`.
[[nodiscard]] AlignedGrid blocks_of(const AlignedGrid& fine, Factor factor, float value);

/// The lowest value of each block; `no_value` where none of its cells has one.
[[nodiscard]] AlignedGrid lowest_of_blocks(const AlignedGrid& fine, Factor factor);

/// Calls use(cell index, block index) for every cell of `fine`, row by row.
template <typename Use>
void for_each_in_block(const AlignedGrid& fine, const AlignedGrid& blocks, Factor factor, Use use) {
    for (std::int32_t i = 0; i < fine.grid.rows; ++i) {
        const std::int32_t block_row = block_of(fine.first_row + i, factor.down) - blocks.first_row;
        std::size_t cell = fine.grid.index(i, 0);
        std::size_t block =
            blocks.grid.index(block_row, block_of(fine.first_col, factor.across) - blocks.first_col);
        std::int32_t left = factor.across * (block_of(fine.first_col, factor.across) + 1) - fine.first_col;
        for (std::int32_t j = 0; j < fine.grid.cols; ++j, ++cell) {
            if (left == 0) {
                ++block;
                left = factor.across;
            }
            --left;
            use(cell, block);
        }
    }
}

}  // namespace d2b::ground
