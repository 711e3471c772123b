#include "ground/window_pass.hpp"

#include <algorithm>
#include <vector>

#include "ground/down_pass.hpp"

namespace d2b::ground {
namespace {

/// Windows of 2, 4, 8, ... cells from those of half as many; the last two overlap.
template <typename Pick>
void along_rows(const MetreGrid& from, MetreGrid& into, std::int32_t radius) {
    const Pick pick;
    const auto reach = static_cast<std::size_t>(radius);
    const auto cols = static_cast<std::size_t>(from.cols);
    const std::size_t width = 2 * reach + 1;
    std::vector<float> padded(cols + 2 * reach);
    std::vector<float> doubled(padded.size());
    for (std::int32_t i = 0; i < from.rows; ++i) {
        std::fill_n(padded.data(), reach, Pick::neutral);
        std::copy_n(from.row(i).data(), cols, padded.data() + reach);
        std::fill_n(padded.data() + reach + cols, reach, Pick::neutral);
        std::size_t span = 1;
        for (; 2 * span <= width; span *= 2) {
            const std::size_t n = padded.size() - 2 * span + 1;
            const float* near = padded.data();
            const float* far = near + span;
            float* out = doubled.data();
            for (std::size_t j = 0; j < n; ++j)
                out[j] = pick(near[j], far[j]);
            padded.swap(doubled);
        }
        const float* near = padded.data();
        const float* far = near + (width - span);
        float* out = into.row(i).data();
        for (std::size_t j = 0; j < cols; ++j)
            out[j] = pick(near[j], far[j]);
    }
}

template <typename Pick>
void pass(const MetreGrid& from, MetreGrid& into, Line line, std::int32_t radius) {
    if (line == Line::row)
        along_rows<Pick>(from, into, radius);
    else
        DownPass<Pick>(from, into, radius, line == Line::column ? 0 : (line == Line::right_diagonal ? 1 : -1))
            .run();
}

}  // namespace

void window_pass(const MetreGrid& from, MetreGrid& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        pass<Lower>(from, into, line, radius);
    else
        pass<Higher>(from, into, line, radius);
}

MetreGrid lowest_around(const MetreGrid& grid) {
    MetreGrid along(grid.rows, grid.cols);
    MetreGrid around(grid.rows, grid.cols);
    window_pass(grid, along, Line::row, Extremum::lowest, 1);
    window_pass(along, around, Line::column, Extremum::lowest, 1);
    return around;
}

}  // namespace d2b::ground
