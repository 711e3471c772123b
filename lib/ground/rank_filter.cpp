#include "ground/rank_filter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/grid.hpp"

namespace d2b::ground {
namespace {

template <typename Pick>
void combine_by(Pick pick, std::span<const float> cells, std::size_t offset, std::span<float> out) {
    constexpr std::size_t chunk =
        1024;  // copied, because the loop is not vectorised if it may overwrite its input
    std::array<float, chunk> found;
    for (std::size_t begin = 0; begin + offset < cells.size(); begin += chunk) {
        const std::size_t n = std::min(chunk, cells.size() - offset - begin);
        const float* const near = cells.data() + begin;
        const float* const far = near + offset;
        for (std::size_t k = 0; k < n; ++k)
            found[k] = pick(near[k], far[k]);
        std::copy_n(found.data(), n, out.data() + begin);
    }
}

/// Computes the extremum of each cell and the cell `offset` places after it. @param out may be `cells`
void combine(Extremum which, std::span<const float> cells, std::size_t offset, std::span<float> out) {
    if (which == Extremum::lowest)
        combine_by([](float a, float b) { return std::min(a, b); }, cells, offset, out);
    else
        combine_by([](float a, float b) { return std::max(a, b); }, cells, offset, out);
}

/// Computes the minimum of each cell of a row and its eight neighbours.
/// @param column buffer for a row
void minimum_3x3_row(const MetreGrid& grid, std::int32_t row, std::vector<float>& column,
                     std::span<float> lowest) {
    const auto lower = [](float a, float b) { return std::min(a, b); };
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

D2B_MULTIVERSION void RankFilter::apply(MetreGrid& grid, Line line, Extremum which, std::int32_t radius) {
    const std::int32_t down = line == Line::row ? 0 : 1;
    const std::int32_t across = line == Line::column ? 0 : (line == Line::left_diagonal ? -1 : 1);
    const std::int32_t left = across == 0 ? 0 : radius;
    const std::ptrdiff_t cols = grid.cols + 2 * left;
    const float neutral = which == Extremum::lowest ? no_value : -no_value;
    padded_.assign(static_cast<std::size_t>((grid.rows + 2 * down * radius) * cols), neutral);
    const auto in_padded = [&](std::int32_t row, std::int32_t col) {
        return padded_.begin() + (row + down * radius) * cols + col + left;
    };
    for (std::int32_t i = 0; i < grid.rows; ++i)
        std::ranges::copy(grid.row(i), in_padded(i, 0));
    // Lines that leave a row of the padded grid at one end and enter the next are of no use, and never used.
    const auto step = static_cast<std::size_t>(down * cols + across);
    const std::int32_t width = 2 * radius + 1;
    std::int32_t span = 1;
    for (; 2 * span <= width; span *= 2)
        combine(which, padded_, static_cast<std::size_t>(span) * step, padded_);
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        const auto begin =
            static_cast<std::size_t>(in_padded(i - down * radius, -across * radius) - padded_.begin());
        const std::size_t rest = static_cast<std::size_t>(width - span) * step;
        combine(which, std::span(padded_).subspan(begin, grid.row(i).size() + rest), rest, grid.row(i));
    }
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
