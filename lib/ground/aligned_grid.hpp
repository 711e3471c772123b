#pragma once

#include <cstdint>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::ground {

/// Grid with the position of its first cell on the grid of the whole raster at the same cell size. Blocks are
/// aligned to that grid, so that any window is divided as the whole raster is.
struct AlignedGrid {
    MetreGrid grid;
    std::int32_t first_row = 0;
    std::int32_t first_col = 0;
    CellSize cell;
};

/// Returns the same grid without values.
[[nodiscard]] AlignedGrid shape_of(const AlignedGrid& grid);

/// Cells per block.
struct Factor {
    std::int32_t down = 1;
    std::int32_t across = 1;
};
inline constexpr Factor twice{2, 2};  ///< factor between pyramid levels

/// Returns the block that contains a cell; blocks before the first cell of the raster are negative.
[[nodiscard]] constexpr std::int32_t block_of(std::int32_t cell, std::int32_t factor) {
    return cell >= 0 ? cell / factor : -((-cell + factor - 1) / factor);
}

/// Returns the factor that gives blocks of about `wanted` metres.
[[nodiscard]] Factor factor_for(const CellSize& cell, double wanted);

/// Returns the blocks that cover `fine`, all set to `value`.
[[nodiscard]] AlignedGrid blocks_of(const AlignedGrid& fine, Factor factor, float value, Executor& threads);

/// Lowers blocks to the minimum of their cells in a row; NaN and `no_value` are ignored.
/// @param first number of the row's first cell on the raster's grid; the first block is the one of that cell
void lower_blocks(std::span<const float> cells, std::int32_t first, std::int32_t factor,
                  std::span<float> blocks);

/// Copies the value of each block to its cells in a row. @param first as in lower_blocks()
void spread_blocks(std::span<const float> blocks, std::int32_t first, std::int32_t factor,
                   std::span<float> cells);

/// Returns the minimum of each block, or `no_value` if none of its cells has a value.
/// @param values of the cells of `shape`, whose own values are not used; NaN or `no_value` if there is none
[[nodiscard]] AlignedGrid lowest_of_blocks(const AlignedGrid& shape, const MetreGrid& values, Factor factor,
                                           Executor& threads);

}  // namespace d2b::ground
