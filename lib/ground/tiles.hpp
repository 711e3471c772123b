#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace d2b::ground {

/// A rectangle of cells of a grid.
struct Tile {
    std::int32_t row = 0;
    std::int32_t col = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
};

/// Tiles of this side stay in a processor's larger caches with room around them for elements.
inline constexpr std::int32_t tile_side = 640;

/// Tiles that cover a grid, about as large as each other and at most `side` cells long and wide.
[[nodiscard]] std::vector<Tile> tiles_of(std::int32_t rows, std::int32_t cols, std::int32_t side);

/// A tile and so many cells on each side of it, as far as a grid of this shape has them.
[[nodiscard]] Tile widened(const Tile& tile, std::int32_t reach, const MetreGrid& grid);

/// @param part the tile's cells of the grid; keeps its memory from one tile to the next
void copy_tile(const MetreGrid& grid, const Tile& tile, MetreGrid& part);

}  // namespace d2b::ground
