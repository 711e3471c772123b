#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contours/merge_regions.hpp"
#include "core/grid.hpp"
#include "core/lattice.hpp"
#include "geometry/vec2.hpp"

namespace d2b::roofs {

/// Cells of one building on the rectangle around it, with their elevations in metres above its first valid
/// cell. Positions are in cells from the centre of the rectangle, x along a row and y down a column.
struct BuildingGrid {
    std::int32_t first_row = 0;
    std::int32_t first_col = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    double x_step = 1;                 ///< width of a column, in sides of a square with the area of a cell
    double y_step = 1;                 ///< height of a row
    double cell_m = 1;                 ///< side in metres of a square with the area of a cell
    double sine = 1;                   ///< sine of the angle between columns and rows
    double cosine = 0;                 ///< its cosine: not 0 if the grid is sheared
    double datum = 0;                  ///< elevation of 0, in metres
    std::vector<float> elevations;     ///< NaN outside of the building and where not valid
    std::vector<std::uint8_t> inside;  ///< 1 in cells of the building

    [[nodiscard]] std::size_t size() const { return elevations.size(); }
    [[nodiscard]] std::size_t index(std::int32_t row, std::int32_t col) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
    }
    /// Position of a lattice corner (or a point between corners) of the grid.
    [[nodiscard]] double x(double col) const { return (col - 0.5 * cols) * x_step; }
    [[nodiscard]] double y(double row) const { return (row - 0.5 * rows) * y_step; }
    /// Centre of a cell.
    [[nodiscard]] Vec2 centre(std::size_t cell) const {
        const std::size_t at_row = cell / static_cast<std::size_t>(cols);
        const std::size_t at_col = cell % static_cast<std::size_t>(cols);
        return {x(static_cast<double>(at_col) + 0.5), y(static_cast<double>(at_row) + 0.5)};
    }
    /// Elevation of a cell; NaN outside of the building and where not valid.
    [[nodiscard]] double elevation(std::size_t cell) const { return static_cast<double>(elevations[cell]); }
    /// Rise in metres per cell along the fall of a plane.
    [[nodiscard]] double steepness(double slope_x, double slope_y) const {
        return std::hypot(slope_x, (slope_y - cosine * slope_x) / sine);
    }
    [[nodiscard]] double col(double x) const { return x / x_step + 0.5 * cols; }
    [[nodiscard]] double row(double y) const { return y / y_step + 0.5 * rows; }
};

/// Lays out the cells of a building. @param box rows and columns to be covered as well @param margin cells
/// around both @param metres metres per unit of the elevations
[[nodiscard]] BuildingGrid make_building_grid(const contours::BuildingCells& cells, const LatticeBox& box,
                                              std::int32_t margin, const CellSize& cell, double metres);

/// Nearest label of each cell: its own, or outside of the labels that of the nearest labelled cell, one of
/// several that are equally near (Meijster et al. 2000). @param labels -1: none
struct NearestLabels {
    std::vector<std::int32_t> labels;
    std::vector<float> distances;  ///< cells
};
[[nodiscard]] NearestLabels nearest_labels(const std::vector<std::int32_t>& labels, std::int32_t rows,
                                           std::int32_t cols);

}  // namespace d2b::roofs
