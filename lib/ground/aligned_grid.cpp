#include "ground/aligned_grid.hpp"

#include <algorithm>
#include <cmath>

#include "ground/window_pass.hpp"

namespace d2b::ground {

Factor factor_for(const CellSize& cell, double wanted) {
    const auto cells = [wanted](double size) {
        return static_cast<std::int32_t>(std::clamp(std::round(wanted / size), 1.0, 1024.0));
    };
    return {cells(cell.down), cells(cell.across)};
}

AlignedGrid blocks_of(const AlignedGrid& fine, Factor factor, float value) {
    AlignedGrid blocks;
    blocks.first_row = block_of(fine.first_row, factor.down);
    blocks.first_col = block_of(fine.first_col, factor.across);
    blocks.cell = {fine.cell.across * factor.across, fine.cell.down * factor.down};
    blocks.grid =
        MetreGrid(block_of(fine.first_row + fine.grid.rows - 1, factor.down) - blocks.first_row + 1,
                  block_of(fine.first_col + fine.grid.cols - 1, factor.across) - blocks.first_col + 1, value);
    return blocks;
}

AlignedGrid lowest_of_blocks(const AlignedGrid& fine, Factor factor) {
    AlignedGrid blocks = blocks_of(fine, factor, no_value);
    for_each_in_block(fine, blocks, factor, [&](std::size_t cell, std::size_t block) {
        blocks.grid.values[block] = std::min(blocks.grid.values[block], fine.grid.values[cell]);
    });
    return blocks;
}

}  // namespace d2b::ground
