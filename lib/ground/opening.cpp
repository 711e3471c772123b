#include "ground/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/processors.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

template <typename T>
void fit(Grid<T>& grid, const Grid<T>& like) {
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
void take_margin(const Grid<T>& wide, Radius margin, Grid<T>& grid) {
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::copy_n(wide.row(i + margin.down).begin() + margin.across, grid.cols, grid.row(i).begin());
}

/// An element that holds no value must not be the highest one.
template <typename T>
void turn_around(Grid<T>& grid, T from, T to) {
    for (T& value : grid.values)
        value = value == from ? to : value;
}

template <typename T>
void keep_gaps(const Grid<T>& surface, Grid<T>& opened) {
    constexpr T none = no_value_of<T>;
    for (std::size_t k = 0; k < surface.size(); ++k)
        opened.values[k] = surface.values[k] == none ? none : opened.values[k];
}

/// Opens the surface with room around it for elements that reach out of it.
template <typename T, typename Open>
void with_room(const Grid<T>& surface, Radius outside, Workspace<T>& workspace, Grid<T>& opened, Open open) {
    fit(opened, surface);
    if (outside.down <= 0 && outside.across <= 0) {
        open(surface, opened);
    } else {
        const Radius margin{std::max(outside.down, 0), std::max(outside.across, 0)};
        add_margin(surface, margin, workspace.roomy);
        fit(workspace.roomy_opened, workspace.roomy);
        open(workspace.roomy, workspace.roomy_opened);
        take_margin(workspace.roomy_opened, margin, opened);
    }
    if (workspace.gaps)
        keep_gaps(surface, opened);
}

/// An element that holds no value is the lowest.
template <typename T>
void sink_gaps(Grid<T>& lowest) {
    turn_around(lowest, no_value_of<T>, static_cast<T>(-no_value_of<T>));
}

template <typename T>
void open_along(const Grid<T>& surface, Line line, std::int32_t radius, Workspace<T>& workspace,
                Grid<T>& opened) {
    Grid<T>& scratch = workspace.first;
    fit(opened, surface);
    line_pass(surface, scratch, line, Extremum::lowest, radius);
    sink_gaps(scratch);
    line_pass(scratch, opened, line, Extremum::highest, radius);
}

/// The second highest of four values, cell by cell.
template <typename T>
void second_highest(const std::array<Grid<T>, 4>& of, Grid<T>& into) {
    for (std::size_t k = 0; k < into.size(); ++k) {
        const T a = of[0].values[k];
        const T b = of[1].values[k];
        const T c = of[2].values[k];
        const T d = of[3].values[k];
        into.values[k] =
            std::max(std::min(std::max(a, b), std::max(c, d)), std::max(std::min(a, b), std::min(c, d)));
    }
}

template <typename T>
void open_by_rectangle(const Grid<T>& grid, Radius radius, Workspace<T>& workspace, Grid<T>& out) {
    Grid<T>& scratch = workspace.first;
    fit(scratch, grid);
    line_pass(grid, scratch, Line::row, Extremum::lowest, radius.across);
    line_pass(scratch, out, Line::column, Extremum::lowest, radius.down);
    if (workspace.gaps)  // without them each element holds a cell with a value
        sink_gaps(out);
    line_pass(out, scratch, Line::column, Extremum::highest, radius.down);
    line_pass(scratch, out, Line::row, Extremum::highest, radius.across);
}

template <typename T>
void open_by_lines(const Grid<T>& grid, Radius radius, Workspace<T>& workspace, Grid<T>& out) {
    const auto diagonal =
        std::max(1, static_cast<std::int32_t>(std::lround(0.7071 * std::max(radius.down, radius.across))));
    fit(workspace.first, grid);
    open_along(grid, Line::row, radius.across, workspace, workspace.lines[0]);
    open_along(grid, Line::column, radius.down, workspace, workspace.lines[1]);
    open_along(grid, Line::right_diagonal, diagonal, workspace, workspace.lines[2]);
    open_along(grid, Line::left_diagonal, diagonal, workspace, workspace.lines[3]);
    second_highest(workspace.lines, out);
}

template <typename T>
void open_by(Element element, const Grid<T>& surface, Radius radius, Radius outside, Workspace<T>& workspace,
             Grid<T>& opened) {
    with_room(surface, outside, workspace, opened, [&](const Grid<T>& grid, Grid<T>& out) {
        if (element == Element::rectangle)
            open_by_rectangle(grid, radius, workspace, out);
        else
            open_by_lines(grid, radius, workspace, out);
    });
}

template <typename T>
void close_by_rectangle(const Grid<T>& surface, Radius radius, Workspace<T>& workspace, Grid<T>& closed) {
    constexpr T none = no_value_of<T>;
    constexpr T below = static_cast<T>(-none);
    Grid<T>& scratch = workspace.first;
    fit(scratch, surface);
    fit(closed, surface);
    for (std::size_t k = 0; k < surface.size(); ++k)
        closed.values[k] = surface.values[k] == none ? below : surface.values[k];
    line_pass(closed, scratch, Line::row, Extremum::highest, radius.across);
    line_pass(scratch, closed, Line::column, Extremum::highest, radius.down);
    turn_around(closed, below, none);
    line_pass(closed, scratch, Line::row, Extremum::lowest, radius.across);
    line_pass(scratch, closed, Line::column, Extremum::lowest, radius.down);
}

}  // namespace

D2B_FOR_EACH_PROCESSOR void open(Element element, const Grid<float>& surface, Radius radius, Radius outside,
                                 Workspace<float>& workspace, Grid<float>& opened) {
    open_by(element, surface, radius, outside, workspace, opened);
}

D2B_FOR_EACH_PROCESSOR void open(Element element, const Grid<std::int16_t>& surface, Radius radius,
                                 Radius outside, Workspace<std::int16_t>& workspace,
                                 Grid<std::int16_t>& opened) {
    open_by(element, surface, radius, outside, workspace, opened);
}

D2B_FOR_EACH_PROCESSOR void closed_by_rectangle(const MetreGrid& surface, Radius radius,
                                                Workspace<float>& workspace, MetreGrid& closed) {
    close_by_rectangle(surface, radius, workspace, closed);
}

D2B_FOR_EACH_PROCESSOR void closed_by_rectangle(const Grid<std::int16_t>& surface, Radius radius,
                                                Workspace<std::int16_t>& workspace,
                                                Grid<std::int16_t>& closed) {
    close_by_rectangle(surface, radius, workspace, closed);
}

}  // namespace d2b::ground
