#pragma once

#include <array>
#include <cstdint>

#include "core/grid.hpp"

namespace d2b::ground {

/// Half a structuring element in cells.
struct Radius {
    std::int32_t down = 1;
    std::int32_t across = 1;
};

/// Grids that openings work in; kept from one to the next, so that memory is asked for once.
struct Workspace {
    MetreGrid first;
    std::array<MetreGrid, 4> lines;
    MetreGrid roomy, roomy_opened;
    bool gaps = true;  ///< whether the surface may have cells without a value
};

/// The morphological opening by a rectangle: at each cell the highest of the lowest values of all positions
/// of it that hold the cell. Cells without a value are left out; they keep `no_value`. Structuring elements
/// reach out of the grid by at most `outside` cells.
/// @param opened another grid than `surface`
void opened_by_rectangle(const MetreGrid& surface, Radius radius, Radius outside, Workspace& workspace,
                         MetreGrid& opened);

/// The second highest of the openings by lines along the row, the column and both diagonals: what is as low
/// in three directions of four is cut, while the edge of a terrace, a ridge or a dam stays.
void opened_by_lines(const MetreGrid& surface, Radius radius, Radius outside, Workspace& workspace,
                     MetreGrid& opened);

/// The closing by a rectangle: the lowest of the highest values.
/// @param closed another grid than `surface`
void closed_by_rectangle(const MetreGrid& surface, Radius radius, Workspace& workspace, MetreGrid& closed);

}  // namespace d2b::ground
