#pragma once

#include "ground/aligned_grid.hpp"
#include "ground/opening.hpp"

namespace d2b::ground {

using Opening = void (*)(const MetreGrid&, Radius, Radius, Workspace&, MetreGrid&);

/// Which windows are opened, and what rises too far above them.
struct Windows {
    double radius = 1;         ///< of the next window, metres
    double last_radius = 1;    ///< of the widest
    double rise = 0;           ///< an object rises above the opened surface by this ...
    double slope = 0;          ///< ... and this times the radius
    double growth = 1.2;       ///< from a window to the next, but at least by a cell
    double border_reach = 14;  ///< windows reach as far into the grid at its border, or their whole radius
};

/// A surface without objects up to some width, and the height above which a cell was part of one; `no_value`
/// where it was of none.
struct Opened {
    AlignedGrid surface;
    MetreGrid limits;
    double next_radius = 0;  ///< of the window that would be next
};

/// Progressive opening (SMRF): each window opens what the one before has left. All windows on the cells as
/// they are.
[[nodiscard]] Opened open_on_cells(const AlignedGrid& surface, const Windows& windows, Opening open);

/// The limits of the same, but windows of more than some ten cells are opened on blocks of 2 x 2 cells, and
/// so on: the cost a cell does not grow with the widest window.
[[nodiscard]] MetreGrid limits_on_blocks(const AlignedGrid& surface, const Windows& windows, Opening open);

/// A block's limit holds for its cells and, as walls do not run along blocks, for those of its neighbours,
/// but for what the ground may rise until there.
[[nodiscard]] MetreGrid with_neighbours_limits(const MetreGrid& limits, const CellSize& cell);

}  // namespace d2b::ground
