#include "ground/aligned_grid.hpp"

#include <algorithm>
#include <cmath>

#include "raster/rank_filter.hpp"

namespace d2b::ground {

std::vector<Tile> tiles_of(std::int32_t rows, std::int32_t cols, std::int32_t side) {
    const auto begin = [side](std::int32_t length, std::int32_t i) {
        const std::int64_t parts = (length + side - 1) / side;
        return static_cast<std::int32_t>(length * std::int64_t{i} / parts);
    };
    std::vector<Tile> tiles;
    for (std::int32_t i = 0; i * side < rows; ++i)
        for (std::int32_t j = 0; j * side < cols; ++j) {
            const std::int32_t row = begin(rows, i);
            const std::int32_t col = begin(cols, j);
            tiles.push_back({row, col, begin(rows, i + 1) - row, begin(cols, j + 1) - col});
        }
    return tiles;
}

Tile widened(const Tile& tile, std::int32_t reach, const MetreGrid& grid) {
    const std::int32_t row = std::max(tile.row - reach, 0);
    const std::int32_t col = std::max(tile.col - reach, 0);
    return {row, col, std::min(tile.row + tile.rows + reach, grid.rows) - row,
            std::min(tile.col + tile.cols + reach, grid.cols) - col};
}

void copy_tile(const MetreGrid& grid, const Tile& tile, MetreGrid& part) {
    part.rows = tile.rows;
    part.cols = tile.cols;
    part.values.resize(part.index(part.rows, 0));
    for (std::int32_t i = 0; i < tile.rows; ++i)
        std::copy_n(grid.row(tile.row + i).data() + tile.col, tile.cols, part.row(i).data());
}

namespace {

/// Returns the blocks that cover `fine`, without values.
AlignedGrid block_shape(const AlignedGrid& fine, BlockSize factor) {
    AlignedGrid blocks;
    blocks.first_row = block_of(fine.first_row, factor.down);
    blocks.first_col = block_of(fine.first_col, factor.across);
    blocks.cell = {fine.cell.across * factor.across, fine.cell.down * factor.down};
    blocks.grid.rows = block_of(fine.first_row + fine.grid.rows - 1, factor.down) - blocks.first_row + 1;
    blocks.grid.cols = block_of(fine.first_col + fine.grid.cols - 1, factor.across) - blocks.first_col + 1;
    return blocks;
}

}  // namespace

AlignedGrid without_values(const AlignedGrid& grid) {
    AlignedGrid shape;
    shape.grid.rows = grid.grid.rows;
    shape.grid.cols = grid.grid.cols;
    shape.first_row = grid.first_row;
    shape.first_col = grid.first_col;
    shape.cell = grid.cell;
    return shape;
}

BlockSize block_size_for(const CellSize& cell, double wanted) {
    const auto cells = [wanted](double size) {
        return static_cast<std::int32_t>(std::clamp(std::round(wanted / size), 1.0, 1024.0));
    };
    return {cells(cell.down), cells(cell.across)};
}

AlignedGrid blocks_of(const AlignedGrid& fine, BlockSize factor, float value, Executor& threads) {
    AlignedGrid blocks = block_shape(fine, factor);
    blocks.grid = MetreGrid(blocks.grid.rows, blocks.grid.cols, value, threads);
    return blocks;
}

void lower_blocks_to_minima(std::span<const float> cells, std::int32_t first, std::int32_t factor,
                            std::span<float> blocks) {
    const auto lower = [](float a, float b) { return a < b ? a : b; };
    if (factor == 1) {
        for (std::size_t j = 0; j < cells.size(); ++j)
            blocks[j] = lower(cells[j], blocks[j]);
        return;
    }
    auto in_block = static_cast<std::size_t>(first - block_of(first, factor) * factor);
    std::size_t block = 0;
    for (std::size_t j = 0; j < cells.size(); ++block, in_block = 0)
        for (; in_block < static_cast<std::size_t>(factor) && j < cells.size(); ++in_block, ++j)
            blocks[block] = lower(cells[j], blocks[block]);
}

void copy_blocks_to_cells(std::span<const float> blocks, std::int32_t first, std::int32_t factor,
                          std::span<float> cells) {
    const auto before = static_cast<std::size_t>(first - block_of(first, factor) * factor);
    const auto step = static_cast<std::size_t>(factor);
    std::size_t j = 0;
    for (std::size_t block = 0; j < cells.size(); ++block) {
        const std::size_t end = std::min((block + 1) * step - before, cells.size());
        for (; j < end; ++j)
            cells[j] = blocks[block];
    }
}

AlignedGrid block_minima(const AlignedGrid& shape, const MetreGrid& values, BlockSize factor,
                         Executor& threads) {
    AlignedGrid blocks = block_shape(shape, factor);
    blocks.grid = MetreGrid::unset(blocks.grid.rows, blocks.grid.cols, threads);
    const auto cols = static_cast<std::size_t>(values.cols);
    for_row_bands(threads, blocks.grid.rows, values.cols, [&](RowBand band) {
        std::vector<float> lowest(cols);
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::int32_t first = (blocks.first_row + row) * factor.down - shape.first_row;
            std::fill(lowest.begin(), lowest.end(), no_value);
            for (std::int32_t i = std::max(first, 0); i < std::min(first + factor.down, values.rows); ++i)
                lower_blocks_to_minima(values.row(i), 0, 1, lowest);
            const auto out = blocks.grid.row(row);
            std::fill(out.begin(), out.end(), no_value);
            lower_blocks_to_minima(lowest, shape.first_col, factor.across, out);
        }
    });
    return blocks;
}

}  // namespace d2b::ground
