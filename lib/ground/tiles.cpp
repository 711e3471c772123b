#include "ground/tiles.hpp"

#include <algorithm>

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

}  // namespace d2b::ground
