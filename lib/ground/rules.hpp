#pragma once

#include "core/grid.hpp"

namespace d2b::ground {

/// Parameters of the ground filter, in metres and metres per metre. One set for all places, without options.
/// The defaults are for cells of up to one metre, see rules_for().
struct Rules {
    double work_cell = 1;       ///< approximate cell size of the grid for small objects
    double outlier_depth = 5;   ///< depth of a low outlier below the lowest ground around it
    double outlier_radius = 1;  ///< outliers are closed by an element of this radius
    double outlier_reach = 25;  ///< radius of "around it"
    double border_reach = 8;    ///< elements extend into the raster at least this far at its border

    double small_growth = 1.2;   ///< between elements, but at least one cell
    double small_radius = 8;     ///< radius of the widest element for small objects
    double small_slope = 0.18;   ///< a small object rises above the opened surface by this times the radius
    double small_border = 12;    ///< within this distance from the border of the raster ...
    double border_share = 0.75;  ///< ... an object rises by this share of that, a large one as well

    double block = 2;           ///< approximate cell size of the grid for large objects
    double large_growth = 1.4;  ///< between elements, but at least one block
    double reach = 1.5;         ///< largest radius of an element, in widths of the widest building
    double large_rise = 0.7;    ///< a large object rises above the opened surface by this ...
    double large_slope = 0.05;  ///< ... plus this times the radius
    double large_border = 24;   ///< within this distance from the border, border_share of that
    double line_rise = 2;       ///< same for linear elements
    double line_slope = 0.15;
    double link_slope = 0.3;    ///< steepest slope of ground, or half a wall per block
    double link_rise = 1;       ///< height of ground above the lowest point of its block, at most
    int link_steps = 60;        ///< blocks
    double wall_share = 0.9;    ///< a piece walled along a larger share of its border is a roof ...
    double wall_rise = 1.5;     ///< ... if the surface steps by this much ...
    double wall_length = 5;     ///< ... and it is not longer than this, in widths of the widest building
    double level_share = 0.9;   ///< same share for a large level piece, because a terrace of that size slopes
    double level_slope = 0.05;  ///< slope of its plane, at most
    double level_area = 600;    ///< m2, at least
    double plateau_share =
        0.9;  ///< a plateau that drops by a wall along a larger share of its border is a roof

    double tolerance = 0.4;         ///< ground lies within this distance of the provisional terrain ...
    double tolerance_slope = 1.25;  ///< ... plus this times its slope
    int rounds = 1;                 ///< repetitions of this test
    int relaxations = 3;            ///< smoothing steps per level when gaps are filled
};

/// Returns the rules for a cell size. A coarse cell holds one height, usually that of its highest point, so
/// alleys between houses disappear: roofs and the crowns between them merge and connect to the ground, the
/// street and the border of the raster by smaller steps than a single house.
[[nodiscard]] Rules rules_for(const CellSize& cell);

}  // namespace d2b::ground
