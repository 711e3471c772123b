#include "ground/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/processors.hpp"
#include "ground/line_pass.hpp"
#include "ground/row_opening.hpp"

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

/// Opens or closes by a rectangle. The order of passes along columns matters; the passes along rows are done
/// between them, so that the grid is traversed once instead of four times.
template <typename T>
void rectangle(const Grid<T>& grid, Extremum first, Radius radius, Workspace<T>& workspace, Grid<T>& out,
               const AfterRow<T>& after) {
    double_pass(
        grid, out, Line::column, first, radius.down,
        [&](std::span<T> row) { open_row(row, first, radius.across, workspace.row); }, after);
}

/// Returns a function that clears cells without a value in each opened row.
template <typename T>
AfterRow<T> gaps_kept(const Grid<T>& surface, bool any) {
    if (!any)
        return {};
    return [&surface, i = std::int32_t{0}](std::span<T> row) mutable { keep_gaps(surface.row(i++), row); };
}

/// Opens the surface with a margin for elements that extend beyond it.
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
}

template <typename T>
void open_along(const Grid<T>& surface, Line line, std::int32_t radius, Grid<T>& opened) {
    fit(opened, surface);
    double_pass(surface, opened, line, Extremum::lowest, radius,
                [](std::span<T> row) { turn_row(row, Extremum::lowest); }, {});
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
    open_along(grid, Line::column, radius.down, lines[0]);
    open_along(grid, Line::right_diagonal, diagonal, lines[1]);
    open_along(grid, Line::left_diagonal, diagonal, lines[2]);
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        const std::span<T> row = out.row(i);
        std::ranges::copy(grid.row(i), row.begin());
        open_row(row, Extremum::lowest, radius.across, workspace.row);
        second_highest<T>(row, lines[0].row(i), lines[1].row(i), lines[2].row(i));
        if (workspace.gaps)
            keep_gaps(grid.row(i), row);
    }
}

template <typename T>
void open_by(Element element, const Grid<T>& surface, Radius radius, Radius outside, Workspace<T>& workspace,
             Grid<T>& opened) {
    with_room(surface, outside, workspace, opened, [&](const Grid<T>& grid, Grid<T>& out) {
        if (element == Element::rectangle)
            rectangle(grid, Extremum::lowest, radius, workspace, out, gaps_kept(grid, workspace.gaps));
        else
            open_by_lines(grid, radius, workspace, out);
    });
}

template <typename T>
void close_by_rectangle(const Grid<T>& surface, Radius radius, Workspace<T>& workspace, Grid<T>& closed) {
    Grid<T>& without_gaps = workspace.roomy;
    without_gaps = surface;
    turn_row(std::span<T>(without_gaps.values), Extremum::lowest);
    fit(closed, surface);
    rectangle<T>(without_gaps, Extremum::highest, radius, workspace, closed, {});
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
