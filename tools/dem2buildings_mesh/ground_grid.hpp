// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b::mesh {

/// Elevations of the terrain over the plane of a plan. Cell coordinates: x in columns, y in rows, 0 0 is the
/// outer corner of the first cell.
class GroundGrid {
  public:
    /// Transform from the plane to cells: x = t[0] + t[1] x + t[2] y, y = t[3] + t[4] x + t[5] y.
    using Affine = std::array<double, 6>;

    /// @param elevations in steps of height, row by row; NaN where none is known, but not everywhere: there
    /// the nearest known one is taken
    GroundGrid(std::int32_t rows, std::int32_t cols, std::vector<double> elevations, const Affine& to_cells);

    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    [[nodiscard]] Position cell(const Position& at) const;
    [[nodiscard]] Position plane(const Position& cell) const;
    /// Steps of height: linear between centres of cells, level beyond the outer ones.
    [[nodiscard]] double elevation(const Position& at) const;

    /// Cells whose centres lie within these rings say nothing of the terrain. @param edges from and to, on
    /// the plane; all of some rings
    void leave_out(const std::vector<std::array<Position, 2>>& edges);
    /// Middle on the plane of a cell that errors() names.
    [[nodiscard]] Position middle(std::size_t cell) const;
    /// Number of cells with a known elevation.
    [[nodiscard]] std::int64_t measured() const;
    /// Those of them in a triangle, with how far it is from their elevations. Ends where `take` returns
    /// false.
    /// @param heights of the corners @return whether it went to the end
    bool errors(const std::array<Position, 3>& corners, const std::array<double, 3>& heights,
                const std::function<bool(std::size_t cell, double error)>& take) const;

  private:
    void fill_gaps();

    std::int32_t rows_;
    std::int32_t cols_;
    std::vector<double> elevations_;
    std::vector<bool> measured_;
    Affine to_cells_;
};

}  // namespace d2b::mesh
