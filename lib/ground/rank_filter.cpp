#include "ground/rank_filter.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "core/grid.hpp"

namespace d2b::ground {
namespace {

/// Computes the minimum of each cell of a row and its eight neighbours.
/// @param column buffer for a row
void minimum_3x3_row(const MetreGrid& grid, std::int32_t row, std::vector<float>& column,
                     std::span<float> lowest) {
    const Minimum lower;
    const auto above = grid.row(std::max(row - 1, 0));
    const auto here = grid.row(row);
    const auto below = grid.row(std::min(row + 1, grid.rows - 1));
    const std::size_t last = lowest.size() - 1;
    for (std::size_t j = 0; j <= last; ++j)
        column[j] = lower(lower(above[j], here[j]), below[j]);
    for (std::size_t j = 1; j < last; ++j)
        lowest[j] = lower(lower(column[j - 1], column[j]), column[j + 1]);
    lowest[0] = lower(column[0], column[std::min<std::size_t>(1, last)]);
    lowest[last] = lower(column[last], column[last - std::min<std::size_t>(1, last)]);
}

}  // namespace

D2B_MULTIVERSION void rank_filter(const Grid<float>& from, Grid<float>& into, Line line, Extremum which,
                                  std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

D2B_MULTIVERSION void rank_filter(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line,
                                  Extremum which, std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

D2B_MULTIVERSION void double_rank_filter(const Grid<float>& from, Grid<float>& into, Line line,
                                         Extremum first, std::int32_t radius,
                                         const RowCallback<float>& between, const RowCallback<float>& after) {
    double_rank_filter_impl(from, into, line, first, radius, between, after);
}

D2B_MULTIVERSION void double_rank_filter(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line,
                                         Extremum first, std::int32_t radius,
                                         const RowCallback<std::int16_t>& between,
                                         const RowCallback<std::int16_t>& after) {
    double_rank_filter_impl(from, into, line, first, radius, between, after);
}

MetreGrid minimum_3x3(const MetreGrid& grid, Executor& threads) {
    MetreGrid around = MetreGrid::unset(grid.rows, grid.cols, threads);
    for_row_bands(threads, grid.rows, grid.cols, [&](RowBand band) {
        std::vector<float> column(static_cast<std::size_t>(grid.cols));
        for (std::int32_t i = band.begin; i < band.end; ++i)
            minimum_3x3_row(grid, i, column, around.row(i));
    });
    return around;
}

}  // namespace d2b::ground
