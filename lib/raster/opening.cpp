#include "raster/opening.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace d2b {
namespace {

/// Replaces the neutral element of one extremum by that of the other in cells without data.
template <typename First, typename Second, typename T>
void swap_neutral_values(std::span<T> row) {
    constexpr T from = First::template neutral<T>;
    constexpr T to = Second::template neutral<T>;
    for (T& value : row)
        value = value == from ? to : value;
}

template <typename First, typename Second, typename T>
void open_along_row(std::span<T> row, std::int32_t radius, OpeningBuffers<T>& buffers) {
    const auto reach = static_cast<std::size_t>(radius);
    buffers.first.resize(row.size());
    filter_row<First>(row.data(), row.size(), reach, buffers.lines, buffers.first.data());
    swap_neutral_values<First, Second>(std::span<T>(buffers.first));
    filter_row<Second>(buffers.first.data(), row.size(), reach, buffers.lines, row.data());
}

/// Completes an opening (or closing) by a rectangle for a row of extrema along columns: takes the same
/// extremum along the row, then the opposite one.
template <typename T>
void open_row(std::span<T> row, Extremum first, std::int32_t radius, OpeningBuffers<T>& buffers) {
    if (first == Extremum::lowest)
        open_along_row<Minimum, Maximum>(row, radius, buffers);
    else
        open_along_row<Maximum, Minimum>(row, radius, buffers);
}

/// Clears cells of `opened` that have no value in `surface`.
template <typename T>
void keep_gaps(const Grid<T>& surface, Grid<T>& opened) {
    constexpr T none = no_value_of<T>;
    for (std::size_t k = 0; k < opened.size(); ++k)
        opened.values[k] = surface.values[k] == none ? none : opened.values[k];
}

template <typename T>
void resize_like(Grid<T>& grid, const Grid<T>& like) {
    grid.rows = like.rows;
    grid.cols = like.cols;
    grid.values.resize(like.size());
}

template <typename T>
void add_margin(const Grid<T>& grid, Radius margin, Grid<T>& wide) {
    wide.rows = grid.rows + 2 * margin.down;
    wide.cols = grid.cols + 2 * margin.across;
    wide.values.assign(static_cast<std::size_t>(wide.rows) * static_cast<std::size_t>(wide.cols),
                       no_value_of<T>);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::copy(grid.row(i).begin(), grid.row(i).end(), wide.row(i + margin.down).begin() + margin.across);
}

template <typename T>
void remove_margin(const Grid<T>& wide, Radius margin, Grid<T>& grid) {
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::copy_n(wide.row(i + margin.down).begin() + margin.across, grid.cols, grid.row(i).begin());
}

/// Opens or closes by a rectangle. The passes along columns come first and last, so that those along rows
/// read and write one row at a time.
template <typename T>
void rectangle(const Grid<T>& grid, Extremum first, Radius radius, Workspace<T>& workspace, Grid<T>& out) {
    Grid<T>& between = workspace.lines.front();
    resize_like(between, grid);
    rank_filter(grid, between, Line::column, first, radius.down);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        open_row(between.row(i), first, radius.across, workspace.row);
    const Extremum second = first == Extremum::lowest ? Extremum::highest : Extremum::lowest;
    rank_filter(between, out, Line::column, second, radius.down);
}

/// Opens the surface with a margin for elements that extend beyond it.
template <typename T, typename Open>
void with_margin(const Grid<T>& surface, Radius outside, Workspace<T>& workspace, Grid<T>& opened,
                 Open open) {
    resize_like(opened, surface);
    if (outside.down <= 0 && outside.across <= 0) {
        open(surface, opened);
    } else {
        const Radius margin{std::max(outside.down, 0), std::max(outside.across, 0)};
        add_margin(surface, margin, workspace.padded);
        resize_like(workspace.padded_opened, workspace.padded);
        open(workspace.padded, workspace.padded_opened);
        remove_margin(workspace.padded_opened, margin, opened);
    }
}

template <typename T>
void open_along_line(const Grid<T>& surface, Line line, std::int32_t radius, Grid<T>& between,
                     Grid<T>& opened) {
    resize_like(opened, surface);
    rank_filter(surface, between, line, Extremum::lowest, radius);
    swap_neutral_values<Minimum, Maximum>(std::span<T>(between.values));
    rank_filter(between, opened, line, Extremum::highest, radius);
}

/// Computes the second highest of four values, cell by cell. @param row first values; receives the results
template <typename T>
void second_highest(std::span<T> row, std::span<const T> second, std::span<const T> third,
                    std::span<const T> fourth) {
    for (std::size_t j = 0; j < row.size(); ++j) {
        const T a = row[j];
        const T b = second[j];
        const T c = third[j];
        const T d = fourth[j];
        row[j] = std::max(std::min(std::max(a, b), std::max(c, d)), std::max(std::min(a, b), std::min(c, d)));
    }
}

template <typename T>
void open_by_lines(const Grid<T>& grid, Radius radius, Workspace<T>& workspace, Grid<T>& out) {
    const auto diagonal =
        std::max(1, static_cast<std::int32_t>(std::lround(0.7071 * std::max(radius.down, radius.across))));
    std::array<Grid<T>, 3>& lines = workspace.lines;
    open_along_line(grid, Line::column, radius.down, out, lines[0]);
    open_along_line(grid, Line::right_diagonal, diagonal, out, lines[1]);
    open_along_line(grid, Line::left_diagonal, diagonal, out, lines[2]);
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        const std::span<T> row = out.row(i);
        std::ranges::copy(grid.row(i), row.begin());
        open_row(row, Extremum::lowest, radius.across, workspace.row);
        second_highest<T>(row, lines[0].row(i), lines[1].row(i), lines[2].row(i));
    }
}

template <typename T>
void open_by(ElementShape element, const Grid<T>& surface, Radius radius, Radius outside,
             Workspace<T>& workspace, Grid<T>& opened) {
    with_margin(surface, outside, workspace, opened, [&](const Grid<T>& grid, Grid<T>& out) {
        if (element == ElementShape::rectangle)
            rectangle(grid, Extremum::lowest, radius, workspace, out);
        else
            open_by_lines(grid, radius, workspace, out);
        if (workspace.gaps)
            keep_gaps(grid, out);
    });
}

template <typename T>
void close_rectangle_impl(const Grid<T>& surface, Radius radius, Workspace<T>& workspace, Grid<T>& closed) {
    Grid<T>& without_gaps = workspace.padded;
    without_gaps = surface;
    swap_neutral_values<Minimum, Maximum>(std::span<T>(without_gaps.values));
    resize_like(closed, surface);
    rectangle(without_gaps, Extremum::highest, radius, workspace, closed);
}

}  // namespace

D2B_MULTIVERSION void open(ElementShape element, const Grid<float>& surface, Radius radius, Radius outside,
                           Workspace<float>& workspace, Grid<float>& opened) {
    open_by(element, surface, radius, outside, workspace, opened);
}

D2B_MULTIVERSION void open(ElementShape element, const Grid<std::int16_t>& surface, Radius radius,
                           Radius outside, Workspace<std::int16_t>& workspace, Grid<std::int16_t>& opened) {
    open_by(element, surface, radius, outside, workspace, opened);
}

D2B_MULTIVERSION void close_rectangle(const MetreGrid& surface, Radius radius, Workspace<float>& workspace,
                                      MetreGrid& closed) {
    close_rectangle_impl(surface, radius, workspace, closed);
}

D2B_MULTIVERSION void close_rectangle(const Grid<std::int16_t>& surface, Radius radius,
                                      Workspace<std::int16_t>& workspace, Grid<std::int16_t>& closed) {
    close_rectangle_impl(surface, radius, workspace, closed);
}

}  // namespace d2b
