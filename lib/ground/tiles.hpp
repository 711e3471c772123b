#pragma once

#include <cstdint>
#include <vector>

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

}  // namespace d2b::ground
