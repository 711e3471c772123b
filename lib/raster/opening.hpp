#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "raster/rank_filter.hpp"

namespace d2b {

/// Buffers reused between rows.
template <typename T>
struct OpeningBuffers {
    RowBuffers<T> lines;
    std::vector<T> first;
};

/// Buffers of openings, reused so that memory is allocated once.
template <typename T>
struct Workspace {
    std::array<Grid<T>, 3> lines;
    Grid<T> padded, padded_opened;
    OpeningBuffers<T> row;
    bool gaps = true;  ///< true if the surface may have cells without a value
};

enum class ElementShape {
    rectangle,
    lines  ///< along the row, the column and both diagonals
};

/// Morphological opening. By a rectangle: erosion followed by dilation. By lines: second highest of the
/// openings by each of the four lines. It removes objects that are narrow in three of four directions but
/// keeps edges of terraces, ridges and dams. Cells without a value are ignored and keep `no_value_of<T>`.
/// Structuring elements extend beyond the grid by at most `outside` cells.
/// @param opened grid other than `surface`
void open(ElementShape element, const Grid<float>& surface, Radius radius, Radius outside,
          Workspace<float>& workspace, Grid<float>& opened);
void open(ElementShape element, const Grid<std::int16_t>& surface, Radius radius, Radius outside,
          Workspace<std::int16_t>& workspace, Grid<std::int16_t>& opened);

/// Morphological closing by a rectangle: dilation followed by erosion.
/// @param closed grid other than `surface`
void close_rectangle(const MetreGrid& surface, Radius radius, Workspace<float>& workspace, MetreGrid& closed);
void close_rectangle(const Grid<std::int16_t>& surface, Radius radius, Workspace<std::int16_t>& workspace,
                     Grid<std::int16_t>& closed);

}  // namespace d2b
