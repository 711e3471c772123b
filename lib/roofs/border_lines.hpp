#pragma once

#include <vector>

#include "roofs/building_grid.hpp"
#include "roofs/plane.hpp"

namespace d2b::roofs {

/// Straight line between two faces.
struct BorderLine {
    Vec2 from;
    Vec2 to;
};

struct BorderOptions {
    double max_move = 1.5;  ///< cells: ends of lines are moved by at most this
};

/// Draws the borders between the labels of a building with few straight lines. A border along which two
/// planes meet is a crease: it lies on the line in which they intersect. Other borders are steps, along
/// fitted lines. Lines go on beyond the building for some cells, so that they cross its outline. @param
/// labels of the whole grid, see nearest_labels()
[[nodiscard]] std::vector<BorderLine> border_lines(const BuildingGrid& grid, const NearestLabels& labels,
                                                   const std::vector<Plane>& planes,
                                                   const BorderOptions& options);

}  // namespace d2b::roofs
