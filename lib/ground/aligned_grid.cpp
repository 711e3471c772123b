#include "ground/aligned_grid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/row_bands.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {

namespace {

/// Returns the blocks that cover `fine`, without values.
AlignedGrid shape_of_blocks(const AlignedGrid& fine, Factor factor) {
    AlignedGrid blocks;
    blocks.first_row = block_of(fine.first_row, factor.down);
    blocks.first_col = block_of(fine.first_col, factor.across);
    blocks.cell = {fine.cell.across * factor.across, fine.cell.down * factor.down};
    blocks.grid.rows = block_of(fine.first_row + fine.grid.rows - 1, factor.down) - blocks.first_row + 1;
    blocks.grid.cols = block_of(fine.first_col + fine.grid.cols - 1, factor.across) - blocks.first_col + 1;
    return blocks;
}

}  // namespace

AlignedGrid shape_of(const AlignedGrid& grid) {
    AlignedGrid shape;
    shape.grid.rows = grid.grid.rows;
    shape.grid.cols = grid.grid.cols;
    shape.first_row = grid.first_row;
    shape.first_col = grid.first_col;
    shape.cell = grid.cell;
    return shape;
}

Factor factor_for(const CellSize& cell, double wanted) {
    const auto cells = [wanted](double size) {
        return static_cast<std::int32_t>(std::clamp(std::round(wanted / size), 1.0, 1024.0));
    };
    return {cells(cell.down), cells(cell.across)};
}

AlignedGrid blocks_of(const AlignedGrid& fine, Factor factor, float value, Executor& threads) {
    AlignedGrid blocks = shape_of_blocks(fine, factor);
    blocks.grid = MetreGrid(blocks.grid.rows, blocks.grid.cols, value, threads);
    return blocks;
}

void lower_blocks(std::span<const float> cells, std::int32_t first, std::int32_t factor,
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

void spread_blocks(std::span<const float> blocks, std::int32_t first, std::int32_t factor,
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

AlignedGrid lowest_of_blocks(const AlignedGrid& shape, const MetreGrid& values, Factor factor,
                             Executor& threads) {
    AlignedGrid blocks = shape_of_blocks(shape, factor);
    blocks.grid = MetreGrid::unset(blocks.grid.rows, blocks.grid.cols, threads);
    const auto cols = static_cast<std::size_t>(values.cols);
    for_row_bands(threads, blocks.grid.rows, values.cols, [&](RowBand band) {
        std::vector<float> lowest(cols);
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::int32_t first = (blocks.first_row + row) * factor.down - shape.first_row;
            std::fill(lowest.begin(), lowest.end(), no_value);
            for (std::int32_t i = std::max(first, 0); i < std::min(first + factor.down, values.rows); ++i)
                lower_blocks(values.row(i), 0, 1, lowest);
            const auto out = blocks.grid.row(row);
            std::fill(out.begin(), out.end(), no_value);
            lower_blocks(lowest, shape.first_col, factor.across, out);
        }
    });
    return blocks;
}

}  // namespace d2b::ground
