#pragma once

#include <array>
#include <cstdint>

#include "core/grid.hpp"
#include "ground/row_opening.hpp"

namespace d2b::ground {

/// Half a structuring element in cells.
struct Radius {
    std::int32_t down = 1;
    std::int32_t across = 1;
};

/// Buffers of openings, reused so that memory is allocated once.
template <typename T>
struct Workspace {
    std::array<Grid<T>, 3> lines;
    Grid<T> roomy, roomy_opened;
    OpeningRoom<T> row;
    bool gaps = true;  ///< true if the surface may have cells without a value
};

enum class Element {
    rectangle,
    lines  ///< along the row, the column and both diagonals
};

/// Morphological opening. By a rectangle: erosion followed by dilation. By lines: second highest of the
/// openings by each of the four lines. It removes objects that are narrow in three of four directions but
/// keeps edges of terraces, ridges and dams. Cells without a value are ignored and keep `no_value_of<T>`.
/// Structuring elements extend beyond the grid by at most `outside` cells.
/// @param opened grid other than `surface`
void open(Element element, const Grid<float>& surface, Radius radius, Radius outside,
          Workspace<float>& workspace, Grid<float>& opened);
void open(Element element, const Grid<std::int16_t>& surface, Radius radius, Radius outside,
          Workspace<std::int16_t>& workspace, Grid<std::int16_t>& opened);

/// Morphological closing by a rectangle: dilation followed by erosion.
/// @param closed grid other than `surface`
void closed_by_rectangle(const MetreGrid& surface, Radius radius, Workspace<float>& workspace,
                         MetreGrid& closed);
void closed_by_rectangle(const Grid<std::int16_t>& surface, Radius radius, Workspace<std::int16_t>& workspace,
                         Grid<std::int16_t>& closed);

}  // namespace d2b::ground
