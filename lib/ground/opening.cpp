#include "ground/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/grid.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {
namespace {

/// Makes cells without data neutral for the other extremum.
void swap_neutral(MetreGrid& grid, Extremum from) {
    const float old = from == Extremum::lowest ? no_value : -no_value;
    for (float& value : grid.values)
        value = value == old ? -old : value;
}

void add_margin(const MetreGrid& grid, Radius margin, MetreGrid& wide) {
    wide.rows = grid.rows + 2 * margin.down;
    wide.cols = grid.cols + 2 * margin.across;
    wide.values.assign(wide.index(wide.rows, 0), no_value);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::ranges::copy(grid.row(i), wide.row(i + margin.down).begin() + margin.across);
}

/// Opens or closes by a rectangle.
void apply_rectangle(MetreGrid& grid, Extremum first, Radius radius, RankFilter& filter) {
    const Extremum second = first == Extremum::lowest ? Extremum::highest : Extremum::lowest;
    filter.apply(grid, Line::column, first, radius.down);
    filter.apply(grid, Line::row, first, radius.across);
    swap_neutral(grid, first);
    filter.apply(grid, Line::row, second, radius.across);
    filter.apply(grid, Line::column, second, radius.down);
}

void open_along_line(MetreGrid& grid, Line line, std::int32_t radius, RankFilter& filter) {
    filter.apply(grid, line, Extremum::lowest, radius);
    swap_neutral(grid, Extremum::lowest);
    filter.apply(grid, line, Extremum::highest, radius);
}

void open_by_lines(MetreGrid& grid, Radius radius, Workspace& workspace) {
    const auto diagonal =
        std::max(1, static_cast<std::int32_t>(std::lround(0.7071 * std::max(radius.down, radius.across))));
    workspace.lines.fill(grid);
    auto& [column, right, left] = workspace.lines;
    open_along_line(column, Line::column, radius.down, workspace.filter);
    open_along_line(right, Line::right_diagonal, diagonal, workspace.filter);
    open_along_line(left, Line::left_diagonal, diagonal, workspace.filter);
    open_along_line(grid, Line::row, radius.across, workspace.filter);
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const float a = grid.values[k];
        const float b = column.values[k];
        const float c = right.values[k];
        const float d = left.values[k];
        // The second highest of the four.
        grid.values[k] =
            std::max(std::min(std::max(a, b), std::max(c, d)), std::max(std::min(a, b), std::min(c, d)));
    }
}

}  // namespace

D2B_MULTIVERSION void open(ElementShape element, const MetreGrid& surface, Radius radius, Radius outside,
                           Workspace& workspace, MetreGrid& opened) {
    const Radius margin{std::max(outside.down, 0), std::max(outside.across, 0)};
    MetreGrid& wide = workspace.padded;
    add_margin(surface, margin, wide);
    if (element == ElementShape::rectangle)
        apply_rectangle(wide, Extremum::lowest, radius, workspace.filter);
    else
        open_by_lines(wide, radius, workspace);
    opened = surface;
    for (std::int32_t i = 0; i < opened.rows; ++i) {
        const std::span<float> row = opened.row(i);
        const auto from = wide.row(i + margin.down).subspan(static_cast<std::size_t>(margin.across));
        for (std::size_t j = 0; j < row.size(); ++j)
            row[j] = row[j] == no_value ? no_value : from[j];
    }
}

void close_rectangle(const MetreGrid& surface, Radius radius, Workspace& workspace, MetreGrid& closed) {
    closed = surface;
    swap_neutral(closed, Extremum::lowest);
    apply_rectangle(closed, Extremum::highest, radius, workspace.filter);
}

}  // namespace d2b::ground
