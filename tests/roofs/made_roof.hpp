#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/lattice.hpp"
#include "roofs/building_grid.hpp"
#include "roofs/plane.hpp"

namespace d2b::roofs {

/// Elevation in m at a row and column of the raster, where cell 0 extends from 0 to 1.
using Height = std::function<double(double row, double col)>;

/// Cells of a rectangle from row 10 and column 20 on, of 1 m.
struct MadeRoof {
    static constexpr std::int32_t first_row = 10;
    static constexpr std::int32_t first_col = 20;
    std::int32_t rows;
    std::int32_t cols;
    Height height;

    [[nodiscard]] contours::BuildingCells cells() const {
        contours::BuildingCells cells;
        for (std::int32_t row = first_row; row < first_row + rows; ++row) {
            cells.runs.push_back({row, first_col, first_col + cols});
            for (std::int32_t col = first_col; col < first_col + cols; ++col)
                cells.elevations.push_back(height(row + 0.5, col + 0.5));
        }
        return cells;
    }
    [[nodiscard]] BuildingGrid grid() const {
        return make_building_grid(cells(), {{first_row, first_col}, {first_row + rows, first_col + cols}}, 5,
                                  CellSize{1, 1}, 1);
    }
    /// Outline of the rectangle, with `divisor` points in a step of the fine lattice.
    [[nodiscard]] FinePolygon outline(std::int64_t divisor) const {
        const auto at = [&](std::int32_t row, std::int32_t col) {
            const std::int64_t steps = FinePoint::steps * divisor;
            return FinePoint{row * steps, col * steps};
        };
        return {{at(first_row, first_col), at(first_row + rows, first_col),
                 at(first_row + rows, first_col + cols), at(first_row, first_col + cols)},
                {}};
    }
};

/// Ridge along the rows' direction at a row: 9 m high, and falling to both sides.
inline Height gable(double ridge_row, double slope) {
    return [=](double row, double /*col*/) { return 9 - slope * std::abs(row - ridge_row); };
}

/// Roof that rises from all four sides of a rectangle.
inline Height hip(std::int32_t rows, std::int32_t cols, double slope) {
    return [=](double row, double col) {
        const double r = row - MadeRoof::first_row;
        const double c = col - MadeRoof::first_col;
        return 5 + slope * std::min({r, rows - r, c, cols - c});
    };
}

/// Labels of the cells inside, row by row.
inline std::vector<std::int32_t> labels_inside(const BuildingGrid& grid,
                                               const std::vector<std::int32_t>& labels) {
    std::vector<std::int32_t> inside;
    for (std::size_t i = 0; i < grid.size(); ++i)
        if (grid.inside[i] != 0)
            inside.push_back(labels[i]);
    return inside;
}

/// Plane through an elevation at a row and column of the raster, with slopes in metres per row and column.
inline Plane plane_of(const BuildingGrid& grid, double row, double col, double z, double per_row,
                      double per_col) {
    const double x = grid.x(col - grid.first_col);
    const double y = grid.y(row - grid.first_row);
    return {per_col, per_row, z - grid.datum - per_col * x - per_row * y};
}

}  // namespace d2b::roofs
