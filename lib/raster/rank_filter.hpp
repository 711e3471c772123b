#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b {

/// Half a structuring element in cells.
struct Radius {
    std::int32_t down = 1;
    std::int32_t across = 1;
};

enum class Extremum { lowest, highest };

/// Direction of a linear structuring element: along a row, down a column, or down a diagonal to the right or
/// left.
enum class Line { row, column, right_diagonal, left_diagonal };

/// Value of cells without data in grids of this folder. It is the largest float, so that minima need no test
/// for it.
inline constexpr float no_value = 3.402823466e+38F;

/// Same for grids of other types.
template <typename T>
inline constexpr T no_value_of = no_value;
template <>
inline constexpr std::int16_t no_value_of<std::int16_t> = 32767;

/// Computes the minimum or maximum within `radius` cells along a line, for every cell; lines are clipped at
/// the border of the grid. The cost per cell does not depend on the radius, except along rows, where it grows
/// with its logarithm (in the L1 cache).
/// @param into grid of the same size, other than `from`
void rank_filter(const Grid<float>& from, Grid<float>& into, Line line, Extremum which, std::int32_t radius);
void rank_filter(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum which,
                 std::int32_t radius);

/// Returns the minimum of each cell and its eight neighbours.
[[nodiscard]] MetreGrid minimum_3x3(const MetreGrid& grid, Executor& threads);

struct Minimum {
    template <typename T>
    static constexpr T neutral = no_value_of<T>;
    template <typename T>
    T operator()(T a, T b) const {
        return a < b ? a : b;
    }
};
struct Maximum {
    template <typename T>
    static constexpr T neutral = static_cast<T>(-no_value_of<T>);
    template <typename T>
    T operator()(T a, T b) const {
        return a > b ? a : b;
    }
};

/// Buffers reused between rows.
template <typename T>
struct RowBuffers {
    std::vector<T> padded;
    std::vector<T> doubled;
};

/// Computes the extremum of each line of 2 * reach + 1 cells along a row from extrema of 2, 4, 8, ... cells;
/// the last two of these overlap. @param out row other than `in`
template <typename Pick, typename T>
void filter_row(const T* in, std::size_t cols, std::size_t reach, RowBuffers<T>& buffers, T* out) {
    const Pick pick;
    const std::size_t width = 2 * reach + 1;
    const std::size_t count = cols + 2 * reach;
    buffers.padded.resize(count);
    buffers.doubled.resize(count);
    std::fill_n(buffers.padded.data(), reach, Pick::template neutral<T>);
    std::copy_n(in, cols, buffers.padded.data() + reach);
    std::fill_n(buffers.padded.data() + reach + cols, reach, Pick::template neutral<T>);
    std::size_t span = 1;
    for (; 2 * span <= width; span *= 2) {
        const std::size_t n = count - 2 * span + 1;
        const T* near = buffers.padded.data();
        const T* far = near + span;
        T* doubled = buffers.doubled.data();
        for (std::size_t j = 0; j < n; ++j)
            doubled[j] = pick(near[j], far[j]);
        buffers.padded.swap(buffers.doubled);
    }
    const T* near = buffers.padded.data();
    const T* far = near + (width - span);
    for (std::size_t j = 0; j < cols; ++j)
        out[j] = pick(near[j], far[j]);
}

}  // namespace d2b
