#pragma once

#include <array>
#include <vector>

namespace d2b {

/// Rectangles of cells: columns, then rows, each the first and the one behind the last.
using CellBox = std::array<std::array<double, 2>, 2>;

/// Whether no cell is in two of them. @pre none is empty
[[nodiscard]] bool are_apart(std::vector<CellBox> boxes);

}  // namespace d2b
