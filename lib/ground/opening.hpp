#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {

/// Buffers reused between rows.
template <typename T>
struct OpeningBuffers {
    RowBuffers<T> lines;
    std::vector<T> first;
};

/// Completes an opening (or closing) by a rectangle for a row of extrema along columns: takes the same
/// extremum along the row, then the opposite one. Elements without a value become neutral for the second
/// extremum.
void open_row(std::span<float> row, Extremum first, std::int32_t radius, OpeningBuffers<float>& buffers);
void open_row(std::span<std::int16_t> row, Extremum first, std::int32_t radius,
              OpeningBuffers<std::int16_t>& buffers);

/// Replaces the neutral element of one extremum by that of the other in cells without data.
void swap_neutral(std::span<float> row, Extremum from);
void swap_neutral(std::span<std::int16_t> row, Extremum from);

/// Clears cells of `opened` that have no value in `surface`.
void keep_gaps(std::span<const float> surface, std::span<float> opened);
void keep_gaps(std::span<const std::int16_t> surface, std::span<std::int16_t> opened);

/// Half a structuring element in cells.
struct Radius {
    std::int32_t down = 1;
    std::int32_t across = 1;
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

}  // namespace d2b::ground
