#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace d2b {

/// Row of a structuring element: columns [left, right] relative to the origin, `down` rows below it.
struct ElementRow {
    std::int32_t down;
    std::int32_t left;
    std::int32_t right;
};
/// Structuring element. All elements used here contain the origin's column in each row, and their rows are
/// nested intervals.
using Element = std::vector<ElementRow>;

/// True if a disk reaches the centre of another cell.
[[nodiscard]] bool disk_fits(double radius_m, const CellSize& cell);

/// Returns the cells whose centre is within the radius; a block of two by two cells if the radius is less
/// than a cell.
[[nodiscard]] Element disk_element(double radius_m, const CellSize& cell);

}  // namespace d2b
