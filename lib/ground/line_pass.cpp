#include "ground/line_pass.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "core/row_bands.hpp"
#include "ground/down_pass.hpp"
#include "ground/narrow_pass.hpp"

namespace d2b::ground {
namespace {

/// Lines of 2, 4, 8, ... cells from those of half as many; the last two overlap.
template <typename Pick, typename T>
void along_rows(const Grid<T>& from, Grid<T>& into, std::int32_t radius) {
    const Pick pick;
    const auto reach = static_cast<std::size_t>(radius);
    const auto cols = static_cast<std::size_t>(from.cols);
    const std::size_t width = 2 * reach + 1;
    std::vector<T> padded(cols + 2 * reach);
    std::vector<T> doubled(padded.size());
    for (std::int32_t i = 0; i < from.rows; ++i) {
        std::fill_n(padded.data(), reach, Pick::template neutral<T>);
        std::copy_n(from.row(i).data(), cols, padded.data() + reach);
        std::fill_n(padded.data() + reach + cols, reach, Pick::template neutral<T>);
        std::size_t span = 1;
        for (; 2 * span <= width; span *= 2) {
            const std::size_t n = padded.size() - 2 * span + 1;
            const T* near = padded.data();
            const T* far = near + span;
            T* out = doubled.data();
            for (std::size_t j = 0; j < n; ++j)
                out[j] = pick(near[j], far[j]);
            padded.swap(doubled);
        }
        const T* near = padded.data();
        const T* far = near + (width - span);
        T* out = into.row(i).data();
        for (std::size_t j = 0; j < cols; ++j)
            out[j] = pick(near[j], far[j]);
    }
}

template <typename Pick, std::int32_t radius = widest_narrow, typename T>
void narrow_pass(const Grid<T>& from, Grid<T>& into, Line line, std::int32_t wanted) {
    if constexpr (radius > 0)
        if (wanted < radius)
            return narrow_pass<Pick, radius - 1>(from, into, line, wanted);
    if (line == Line::row)
        NarrowPass<Pick, radius, T>::along_rows(from, into);
    else
        NarrowPass<Pick, radius, T>::down_columns(from, into);
}

template <typename Pick, typename T>
void pass(const Grid<T>& from, Grid<T>& into, Line line, std::int32_t radius) {
    if (radius <= widest_narrow && (line == Line::row || line == Line::column))
        narrow_pass<Pick>(from, into, line, radius);
    else if (line == Line::row)
        along_rows<Pick>(from, into, radius);
    else
        DownPass<Pick, T>(from, into, radius,
                          line == Line::column ? 0 : (line == Line::right_diagonal ? 1 : -1))
            .run();
}

/// Of a row and the rows above and below, the lowest value of three columns.
/// @param column room for a row
void lowest_of_nine(const MetreGrid& grid, std::int32_t row, std::vector<float>& column,
                    std::span<float> lowest) {
    const Lower lower;
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

template <typename T>
void line_pass(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        pass<Lower>(from, into, line, radius);
    else
        pass<Higher>(from, into, line, radius);
}

template void line_pass(const Grid<float>&, Grid<float>&, Line, Extremum, std::int32_t);
template void line_pass(const Grid<std::int16_t>&, Grid<std::int16_t>&, Line, Extremum, std::int32_t);

MetreGrid lowest_around(const MetreGrid& grid, Executor& threads) {
    MetreGrid around = MetreGrid::unset(grid.rows, grid.cols, threads);
    for_row_bands(threads, grid.rows, grid.cols, [&](RowBand band) {
        std::vector<float> column(static_cast<std::size_t>(grid.cols));
        for (std::int32_t i = band.begin; i < band.end; ++i)
            lowest_of_nine(grid, i, column, around.row(i));
    });
    return around;
}

}  // namespace d2b::ground
