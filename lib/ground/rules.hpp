#pragma once

#include "core/grid.hpp"

namespace d2b::ground {

/// What the estimate goes by, in metres and metres a metre. One set for all places: none of these is an
/// option. Those here are for cells of up to a metre, see rules_for().
struct Rules {
    double work_cell = 1;     ///< cells of the grid on which small objects are looked for, about
    double pit_depth = 5;     ///< a low outlier lies as far below the lowest ground around it
    double pit_radius = 1;    ///< what an element of this radius closes may be an outlier
    double pit_reach = 25;    ///< how far "around it" goes
    double border_reach = 8;  ///< elements reach into the raster at least as far at its border

    double small_growth = 1.2;   ///< from an element to the next, but at least by a cell
    double small_radius = 8;     ///< of the widest element for small objects
    double small_slope = 0.18;   ///< a small object rises above the opened surface by this times the radius
    double small_border = 12;    ///< as near the border of the raster ...
    double border_share = 0.75;  ///< ... an object rises by this share of that, a large one as well

    double block = 2;           ///< cells of the grid on which large objects are looked for, about
    double large_growth = 1.4;  ///< from an element to the next, but at least by a block
    double reach = 1.5;         ///< no element has a larger radius, in widths of the widest building
    double large_rise = 0.7;    ///< a large object rises above the opened surface by this ...
    double large_slope = 0.05;  ///< ... and this times the radius
    double large_border = 24;   ///< as near the border by border_share of that
    double line_rise = 2;       ///< the same for elements that are lines
    double line_slope = 0.15;
    double link_slope = 0.3;  ///< ground goes on to a neighbour no steeper, or half a wall higher
    double link_rise = 1;     ///< how far above the lowest point of its block ground may lie
    int link_steps = 60;      ///< blocks
    double wall_share = 0.9;  ///< what is walled on more of its border is a roof ...
    double wall_rise = 1.5;   ///< ... where the surface steps by as much ...
    double wall_length = 5;   ///< ... if it is not longer than this, in widths of the widest building
    double plateau_share =
        0.9;  ///< what falls by a wall on more of its border is a roof, however it is reached

    double tolerance = 0.4;         ///< ground lies as near the provisional terrain ...
    double tolerance_slope = 1.25;  ///< ... and this times its slope nearer
    int rounds = 1;                 ///< of this test
    int relaxations = 3;            ///< of smoothing a level when gaps are filled
};

/// The rules for a surface whose cells have a size. A coarse cell holds one height, as a rule that of its
/// highest point, so alleys between houses are not seen: roofs and the crowns between them lie side by side,
/// and reach the ground, the street and the border of the raster in smaller steps than one house alone.
[[nodiscard]] Rules rules_for(const CellSize& cell);

}  // namespace d2b::ground
