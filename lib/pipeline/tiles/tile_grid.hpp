#pragma once

#include <cstdint>
#include <vector>

#include "detect/unit_grid.hpp"

namespace d2b {

/// Unit with its row-major index.
struct PlacedUnit {
    std::int64_t number = 0;  ///< row-major
    Unit unit;
};

/// Groups units into tiles, the portions of work of one process. The result does not depend on the tiles.
/// Tiles are numbered row by row.
class TileGrid {
  public:
    /// @param units must outlive this @param side rows and columns of units in a tile
    TileGrid(const UnitGrid& units, std::int32_t side);

    [[nodiscard]] std::int64_t count() const { return std::int64_t{rows_} * cols_; }
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    [[nodiscard]] const UnitGrid& units() const { return units_; }
    /// Returns the units of a tile, row by row.
    [[nodiscard]] std::vector<PlacedUnit> units_of(std::int64_t tile) const;
    /// Returns the tile that contains a unit.
    [[nodiscard]] std::int64_t tile_of(std::int64_t unit) const;
    [[nodiscard]] PlacedUnit unit(std::int64_t number) const;
    /// Returns the units with own cells in a window, row by row.
    [[nodiscard]] std::vector<PlacedUnit> units_in(const Window& window) const;
    /// Returns the union of all units of a tile.
    [[nodiscard]] Unit whole(std::int64_t tile) const;

  private:
    const UnitGrid& units_;
    std::int32_t side_;
    std::int32_t rows_;
    std::int32_t cols_;
};

/// Returns the bounding window of both; if one is empty, the other one.
[[nodiscard]] Window around(const Window& a, const Window& b);
/// True if the windows intersect.
[[nodiscard]] bool meet(const Window& a, const Window& b);
/// Expands a window by rows and columns on each side, clipped to `within`.
[[nodiscard]] Window grown(const Window& window, std::int32_t rows, std::int32_t cols, const Window& within);

}  // namespace d2b
