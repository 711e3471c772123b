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

/// Grids that openings work in; kept from one to the next, so that memory is asked for once.
template <typename T>
struct Workspace {
    std::array<Grid<T>, 3> lines;
    Grid<T> roomy, roomy_opened;
    OpeningRoom<T> row;
    bool gaps = true;  ///< whether the surface may have cells without a value
};

enum class Element {
    rectangle,
    lines  ///< along the row, the column and both diagonals
};

/// The morphological opening. By a rectangle: at each cell the highest of the lowest values of all positions
/// of it that hold the cell. By lines: the second highest of the openings by each of the four; what is as low
/// in three directions of four is cut, while the edge of a terrace, a ridge or a dam stays. Cells without a
/// value are left out; they keep `no_value_of<T>`. Structuring elements reach out of the grid by at most
/// `outside` cells.
/// @param opened another grid than `surface`
void open(Element element, const Grid<float>& surface, Radius radius, Radius outside,
          Workspace<float>& workspace, Grid<float>& opened);
void open(Element element, const Grid<std::int16_t>& surface, Radius radius, Radius outside,
          Workspace<std::int16_t>& workspace, Grid<std::int16_t>& opened);

/// The closing by a rectangle: the lowest of the highest values.
/// @param closed another grid than `surface`
void closed_by_rectangle(const MetreGrid& surface, Radius radius, Workspace<float>& workspace,
                         MetreGrid& closed);
void closed_by_rectangle(const Grid<std::int16_t>& surface, Radius radius, Workspace<std::int16_t>& workspace,
                         Grid<std::int16_t>& closed);

}  // namespace d2b::ground
