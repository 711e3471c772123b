#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render.hpp"

namespace d2b::bench {

/// Calls visit(index, position) for the cells of some rows whose centres lie in a box; the index counts from
/// the first cell of the first row.
template <typename Visit>
void for_cells(const sample::Rect& box, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
               const Visit& visit) {
    const auto first_in = [](double position, double low, double high) {
        return static_cast<std::int32_t>(std::clamp(std::ceil(position), low, high));
    };
    const std::int32_t left = first_in(box.x0 / grid.cell_x - 0.5, 0, grid.cols);
    const std::int32_t right = first_in(box.x1 / grid.cell_x - 0.5, 0, grid.cols);
    const std::int32_t top = first_in(grid.rows - box.y1 / grid.cell_y - 0.5, first_row, first_row + rows);
    const std::int32_t bottom = first_in(grid.rows - box.y0 / grid.cell_y - 0.5, first_row, first_row + rows);
    for (std::int32_t row = top; row < bottom; ++row) {
        for (std::int32_t col = left; col < right; ++col)
            visit(static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(grid.cols) +
                      static_cast<std::size_t>(col),
                  grid.centre(row, col));
    }
}

}  // namespace d2b::bench
