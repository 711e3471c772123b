#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ground/down_pass.hpp"
#include "ground/narrow_pass.hpp"

namespace d2b::ground {

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

/// What line_pass() does, to be built for one processor or another.
template <typename T>
void either_pass(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        pass<Lower>(from, into, line, radius);
    else
        pass<Higher>(from, into, line, radius);
}

}  // namespace d2b::ground
