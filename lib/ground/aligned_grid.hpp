#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::ground {

/// Rectangle of cells of a grid.
struct Tile {
    std::int32_t row = 0;
    std::int32_t col = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
};

/// Side of tiles that, with surroundings for elements, fit into the larger caches of a processor.
inline constexpr std::int32_t tile_side = 640;

/// Divides a grid into tiles of similar size, at most `side` cells long and wide.
[[nodiscard]] std::vector<Tile> tiles_of(std::int32_t rows, std::int32_t cols, std::int32_t side);

/// Expands a tile by `reach` cells on each side, clipped to the grid.
[[nodiscard]] Tile widened(const Tile& tile, std::int32_t reach, const MetreGrid& grid);

/// Copies the cells of a tile. @param part keeps its memory from one tile to the next
void copy_tile(const MetreGrid& grid, const Tile& tile, MetreGrid& part);

/// Grid with the position of its first cell on the grid of the whole raster at the same cell size. Blocks are
/// aligned to that grid, so that any window is divided as the whole raster is.
struct AlignedGrid {
    MetreGrid grid;
    std::int32_t first_row = 0;
    std::int32_t first_col = 0;
    CellSize cell;
};

/// Returns the same grid without values.
[[nodiscard]] AlignedGrid without_values(const AlignedGrid& grid);

/// Cells per block.
struct BlockSize {
    std::int32_t down = 1;
    std::int32_t across = 1;
};
inline constexpr BlockSize twice{2, 2};  ///< factor between pyramid levels

/// Returns the block that contains a cell; blocks before the first cell of the raster are negative.
[[nodiscard]] constexpr std::int32_t block_of(std::int32_t cell, std::int32_t factor) {
    return cell >= 0 ? cell / factor : -((-cell + factor - 1) / factor);
}

/// Returns the factor that gives blocks of about `wanted` metres.
[[nodiscard]] BlockSize block_size_for(const CellSize& cell, double wanted);

/// Returns the blocks that cover `fine`, all set to `value`.
[[nodiscard]] AlignedGrid blocks_of(const AlignedGrid& fine, BlockSize factor, float value,
                                    Executor& threads);

/// Lowers blocks to the minimum of their cells in a row; NaN and `no_value` are ignored.
/// @param first number of the row's first cell on the raster's grid; the first block is the one of that cell
void lower_blocks_to_minima(std::span<const float> cells, std::int32_t first, std::int32_t factor,
                            std::span<float> blocks);

/// Copies the value of each block to its cells in a row. @param first as in lower_blocks_to_minima()
void copy_blocks_to_cells(std::span<const float> blocks, std::int32_t first, std::int32_t factor,
                          std::span<float> cells);

/// Returns the minimum of each block, or `no_value` if none of its cells has a value.
/// @param values of the cells of `shape`, whose own values are not used; NaN or `no_value` if there is none
[[nodiscard]] AlignedGrid block_minima(const AlignedGrid& shape, const MetreGrid& values, BlockSize factor,
                                       Executor& threads);

}  // namespace d2b::ground
