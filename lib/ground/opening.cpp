#include "ground/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

void fit(MetreGrid& grid, const MetreGrid& like) {
    grid.rows = like.rows;
    grid.cols = like.cols;
    grid.values.resize(like.size());
}

void add_margin(const MetreGrid& grid, Radius margin, MetreGrid& wide) {
    wide.rows = grid.rows + 2 * margin.down;
    wide.cols = grid.cols + 2 * margin.across;
    wide.values.assign(static_cast<std::size_t>(wide.rows) * static_cast<std::size_t>(wide.cols), no_value);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::copy(grid.row(i).begin(), grid.row(i).end(), wide.row(i + margin.down).begin() + margin.across);
}

void take_margin(const MetreGrid& wide, Radius margin, MetreGrid& grid) {
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::copy_n(wide.row(i + margin.down).begin() + margin.across, grid.cols, grid.row(i).begin());
}

/// An element that holds no value must not be the highest one.
void turn_around(MetreGrid& grid, float from, float to) {
    for (float& value : grid.values)
        value = value == from ? to : value;
}

void keep_gaps(const MetreGrid& surface, MetreGrid& opened) {
    for (std::size_t k = 0; k < surface.size(); ++k)
        opened.values[k] = surface.values[k] == no_value ? no_value : opened.values[k];
}

/// Opens the surface with room around it for elements that reach out of it.
template <typename Open>
void with_room(const MetreGrid& surface, Radius outside, Workspace& workspace, MetreGrid& opened, Open open) {
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

void open_along(const MetreGrid& surface, Line line, std::int32_t radius, Workspace& workspace,
                MetreGrid& opened) {
    MetreGrid& scratch = workspace.first;
    fit(opened, surface);
    line_pass(surface, scratch, line, Extremum::lowest, radius);
    turn_around(scratch, no_value, -no_value);
    line_pass(scratch, opened, line, Extremum::highest, radius);
}

/// The second highest of four values, cell by cell.
void second_highest(const std::array<MetreGrid, 4>& of, MetreGrid& into) {
    for (std::size_t k = 0; k < into.size(); ++k) {
        const float a = of[0].values[k];
        const float b = of[1].values[k];
        const float c = of[2].values[k];
        const float d = of[3].values[k];
        into.values[k] =
            std::max(std::min(std::max(a, b), std::max(c, d)), std::max(std::min(a, b), std::min(c, d)));
    }
}

}  // namespace

void opened_by_rectangle(const MetreGrid& surface, Radius radius, Radius outside, Workspace& workspace,
                         MetreGrid& opened) {
    with_room(surface, outside, workspace, opened, [&](const MetreGrid& grid, MetreGrid& out) {
        MetreGrid& scratch = workspace.first;
        fit(scratch, grid);
        line_pass(grid, scratch, Line::row, Extremum::lowest, radius.across);
        line_pass(scratch, out, Line::column, Extremum::lowest, radius.down);
        if (workspace.gaps)  // without them each element holds a cell with a value
            turn_around(out, no_value, -no_value);
        line_pass(out, scratch, Line::column, Extremum::highest, radius.down);
        line_pass(scratch, out, Line::row, Extremum::highest, radius.across);
    });
}

void opened_by_lines(const MetreGrid& surface, Radius radius, Radius outside, Workspace& workspace,
                     MetreGrid& opened) {
    const auto diagonal =
        std::max(1, static_cast<std::int32_t>(std::lround(0.7071 * std::max(radius.down, radius.across))));
    with_room(surface, outside, workspace, opened, [&](const MetreGrid& grid, MetreGrid& out) {
        MetreGrid& scratch = workspace.first;
        fit(scratch, grid);
        open_along(grid, Line::row, radius.across, workspace, workspace.lines[0]);
        open_along(grid, Line::column, radius.down, workspace, workspace.lines[1]);
        open_along(grid, Line::right_diagonal, diagonal, workspace, workspace.lines[2]);
        open_along(grid, Line::left_diagonal, diagonal, workspace, workspace.lines[3]);
        second_highest(workspace.lines, out);
    });
}

void closed_by_rectangle(const MetreGrid& surface, Radius radius, Workspace& workspace, MetreGrid& closed) {
    MetreGrid& scratch = workspace.first;
    closed = surface;
    fit(scratch, surface);
    turn_around(closed, no_value, -no_value);
    line_pass(closed, scratch, Line::row, Extremum::highest, radius.across);
    line_pass(scratch, closed, Line::column, Extremum::highest, radius.down);
    turn_around(closed, -no_value, no_value);
    line_pass(closed, scratch, Line::row, Extremum::lowest, radius.across);
    line_pass(scratch, closed, Line::column, Extremum::lowest, radius.down);
}

}  // namespace d2b::ground
