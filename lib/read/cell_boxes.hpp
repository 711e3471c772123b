#pragma once

#include <array>
#include <vector>

namespace d2b {

/// Rectangle of cells: columns, then rows, as half-open ranges [begin, end).
using CellBox = std::array<std::array<double, 2>, 2>;

/// Returns true if no two boxes overlap. @pre no box is empty
[[nodiscard]] bool are_apart(std::vector<CellBox> boxes);

}  // namespace d2b
