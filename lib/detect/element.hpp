#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace d2b {

/// A row of a structuring element: columns from `left` to `right` of its origin, `down` rows below it.
struct ElementRow {
    std::int32_t down;
    std::int32_t left;
    std::int32_t right;
};
/// All that are used here hold their origin's column in each row, and of any two rows one holds the other.
using Element = std::vector<ElementRow>;

/// Whether a disk reaches another cell's middle.
[[nodiscard]] bool disk_fits(double radius_m, const CellSize& cell);

/// The cells whose middle is within the radius; where that is less than a cell, a block of two by two cells.
[[nodiscard]] Element disk_element(double radius_m, const CellSize& cell);

}  // namespace d2b
