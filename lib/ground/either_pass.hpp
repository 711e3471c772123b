#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ground/down_pass.hpp"
#include "ground/narrow_pass.hpp"
#include "ground/row_pass.hpp"

namespace d2b::ground {

[[nodiscard]] constexpr std::int32_t shift_of(Line line) {
    return line == Line::column ? 0 : (line == Line::right_diagonal ? 1 : -1);
}

/// Calls use() with the NarrowPass of a radius.
template <typename Pick, typename T, std::int32_t radius = widest_narrow, typename Use>
void with_narrow(std::int32_t wanted, const Use& use) {
    if constexpr (radius > 0)
        if (wanted < radius)
            return with_narrow<Pick, T, radius - 1>(wanted, use);
    use(NarrowPass<Pick, radius, T>());
}

template <typename Pick, typename T>
void pass(const Grid<T>& from, Grid<T>& into, Line line, std::int32_t radius) {
    if (line == Line::row) {
        RowRoom<T> room;
        for (std::int32_t i = 0; i < from.rows; ++i)
            along_row<Pick>(from.row(i).data(), from.cols, radius, room, into.row(i).data());
    } else if (line == Line::column && radius <= widest_narrow) {
        with_narrow<Pick, T>(radius, [&](const auto& narrow) {
            for (std::int32_t i = 0; i < from.rows; ++i)
                narrow.down_columns(rows_of(from), i, into.row(i).data());
        });
    } else {
        DownPass<Pick, T>(rows_of(from), rows_of(into), radius, shift_of(line)).run();
    }
}

/// Implements line_pass(), to be compiled for several processors.
template <typename T>
void either_pass(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        pass<Lower>(from, into, line, radius);
    else
        pass<Higher>(from, into, line, radius);
}

/// @param ring for rows of the first pass
template <typename First, typename Second, typename T>
void narrow_double_pass(const Grid<T>& from, Grid<T>& into, std::int32_t radius, const Rows<T>& ring,
                        const AfterRow<T>& between, const AfterRow<T>& after) {
    const auto cols = static_cast<std::size_t>(from.cols);
    std::int32_t done = 0;
    for (std::int32_t i = 0; i < from.rows; ++i) {
        for (; done < std::min(i + radius + 1, from.rows); ++done) {
            T* row = ring.row(done);
            with_narrow<First, T>(radius,
                                  [&](const auto& narrow) { narrow.down_columns(rows_of(from), done, row); });
            between({row, cols});
        }
        with_narrow<Second, T>(
            radius, [&](const auto& narrow) { narrow.down_columns(ring.read(), i, into.row(i).data()); });
        if (after)
            after(into.row(i));
    }
}

template <typename First, typename Second, typename T>
void wide_double_pass(const Grid<T>& from, Grid<T>& into, std::int32_t radius, std::int32_t shift,
                      const Rows<T>& ring, const AfterRow<T>& between, const AfterRow<T>& after) {
    DownPass<First, T> first(rows_of(from), ring, radius, shift);
    DownPass<Second, T> second(ring.read(), rows_of(into), radius, shift);
    first.begin(0, from.cols);
    second.begin(0, from.cols);
    std::int32_t done = 0;
    for (std::int32_t top = 0; top < from.rows; top += second.length()) {
        for (; done < std::min(top + second.length() + radius, from.rows); done += first.length())
            first.block(done, between);
        second.block(top, after);
    }
}

/// Implements double_pass().
template <typename T>
void either_double_pass(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius,
                        const AfterRow<T>& between, const AfterRow<T>& after) {
    const std::int32_t held = std::min(3 * (2 * radius + 1), from.rows);
    std::vector<T> values(static_cast<std::size_t>(held) * static_cast<std::size_t>(from.cols));
    const Rows<T> ring{values.data(), from.rows, from.cols, held};
    const bool lowest = which == Extremum::lowest;
    if (line == Line::column && radius <= widest_narrow)
        lowest ? narrow_double_pass<Lower, Higher>(from, into, radius, ring, between, after)
               : narrow_double_pass<Higher, Lower>(from, into, radius, ring, between, after);
    else
        lowest ? wide_double_pass<Lower, Higher>(from, into, radius, shift_of(line), ring, between, after)
               : wide_double_pass<Higher, Lower>(from, into, radius, shift_of(line), ring, between, after);
}

}  // namespace d2b::ground
