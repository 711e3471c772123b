#pragma once

#include <cstdint>
#include <span>

#include "core/executor.hpp"
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

/// The same without values.
[[nodiscard]] AlignedGrid shape_of(const AlignedGrid& grid);

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
[[nodiscard]] AlignedGrid blocks_of(const AlignedGrid& fine, Factor factor, float value, Executor& threads);

/// Lowers blocks to the lowest of a row of cells; NaN and `no_value` lower nothing.
/// @param first number of the row's first cell on the raster's grid; blocks begin with the one that holds it
void lower_blocks(std::span<const float> cells, std::int32_t first, std::int32_t factor,
                  std::span<float> blocks);

/// Gives each cell of a row the value of its block. @param first as for lower_blocks
void spread_blocks(std::span<const float> blocks, std::int32_t first, std::int32_t factor,
                   std::span<float> cells);

/// The lowest value of each block; `no_value` where none of its cells has one.
/// @param values of the cells of `shape`, whose own are not looked at; NaN or `no_value` where there is none
[[nodiscard]] AlignedGrid lowest_of_blocks(const AlignedGrid& shape, const MetreGrid& values, Factor factor,
                                           Executor& threads);

}  // namespace d2b::ground
