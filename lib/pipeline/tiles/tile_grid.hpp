#pragma once

#include <cstdint>
#include <vector>

#include "detect/unit_grid.hpp"

namespace d2b {

/// A unit and its place among all.
struct PlacedUnit {
    std::int64_t number = 0;  ///< row by row
    Unit unit;
};

/// Units in blocks, by which work is divided: nothing of a result depends on them. Tiles are numbered row by
/// row.
class TileGrid {
  public:
    /// @param units stay the caller's and must outlive this @param side units of a tile in a row, and rows
    TileGrid(const UnitGrid& units, std::int32_t side);

    [[nodiscard]] std::int64_t count() const { return std::int64_t{rows_} * cols_; }
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    [[nodiscard]] const UnitGrid& units() const { return units_; }
    /// The units of a tile, row by row.
    [[nodiscard]] std::vector<PlacedUnit> units_of(std::int64_t tile) const;
    /// The tile that has a unit.
    [[nodiscard]] std::int64_t tile_of(std::int64_t unit) const;
    [[nodiscard]] PlacedUnit unit(std::int64_t number) const;
    /// Those with own cells in a window, row by row.
    [[nodiscard]] std::vector<PlacedUnit> units_in(const Window& window) const;
    /// Of all units of a tile.
    [[nodiscard]] Unit whole(std::int64_t tile) const;

  private:
    const UnitGrid& units_;
    std::int32_t side_;
    std::int32_t rows_;
    std::int32_t cols_;
};

/// The smallest window around both; the other one where one is empty.
[[nodiscard]] Window around(const Window& a, const Window& b);
/// Whether they have cells in common.
[[nodiscard]] bool meet(const Window& a, const Window& b);
/// A window with so many rows and columns more on each side, as far as another has them.
[[nodiscard]] Window grown(const Window& window, std::int32_t rows, std::int32_t cols, const Window& within);

}  // namespace d2b
