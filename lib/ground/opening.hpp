#pragma once

#include <array>
#include <cstdint>

#include "core/grid.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {

/// Half a structuring element in cells.
struct Radius {
    std::int32_t down = 1;
    std::int32_t across = 1;
};

/// Buffers of openings, reused so that memory is allocated once.
struct Workspace {
    RankFilter filter;
    std::array<MetreGrid, 3> lines;
    MetreGrid padded;
};

enum class ElementShape {
    rectangle,
    lines  ///< along the row, the column and both diagonals
};

/// Morphological opening. By a rectangle: erosion followed by dilation. By lines: second highest of the
/// openings by each of the four lines. It removes objects that are narrow in three of four directions but
/// keeps edges of terraces, ridges and dams. Cells without a value are ignored and keep `no_value`.
/// Structuring elements extend beyond the grid by at most `outside` cells.
/// @param opened grid other than `surface`
void open(ElementShape element, const MetreGrid& surface, Radius radius, Radius outside, Workspace& workspace,
          MetreGrid& opened);

/// Morphological closing by a rectangle: dilation followed by erosion.
/// @param closed grid other than `surface`
void close_rectangle(const MetreGrid& surface, Radius radius, Workspace& workspace, MetreGrid& closed);

}  // namespace d2b::ground
