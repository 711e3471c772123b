#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/block_pool.hpp"
#include "core/executor.hpp"

namespace d2b {

/// Values of cells. resize() without a value leaves new ones uninitialised.
template <typename T>
using CellValues = std::vector<T, CellMemory<T>>;

template <typename T>
[[nodiscard]] bool operator==(const CellValues<T>& one, const std::vector<T>& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

/// Values of a window, row by row, for stages that look at neighbourhoods. (0, 0) is the first cell of the
/// window.
template <typename T>
struct Grid {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    CellValues<T> values;

    Grid() = default;
    Grid(std::int32_t row_count, std::int32_t col_count, T value = T{}) : rows(row_count), cols(col_count) {
        values.resize(index(rows, 0), value);
    }
    /// Same, but faster: reuses memory released by earlier grids of this executor.
    Grid(std::int32_t row_count, std::int32_t col_count, T value, Executor& threads)
        : Grid(unset(row_count, col_count, threads)) {
        constexpr std::size_t piece = 1 << 20;
        threads.for_pieces(values.size(), piece, [&](std::size_t begin, std::size_t end) {
            std::fill(values.data() + begin, values.data() + end, value);
        });
    }
    /// Returns a grid with uninitialised values, for callers that set all of them.
    [[nodiscard]] static Grid unset(std::int32_t row_count, std::int32_t col_count, Executor& threads) {
        Grid grid;
        grid.rows = row_count;
        grid.cols = col_count;
        grid.values = CellValues<T>(CellMemory<T>(threads.blocks()));
        grid.values.resize(grid.index(row_count, 0));
        return grid;
    }

    [[nodiscard]] std::size_t size() const { return values.size(); }
    [[nodiscard]] bool holds(std::int32_t row, std::int32_t col) const {
        return row >= 0 && col >= 0 && row < rows && col < cols;
    }
    [[nodiscard]] std::size_t index(std::int32_t row, std::int32_t col) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
    }
    [[nodiscard]] T& at(std::int32_t row, std::int32_t col) { return values[index(row, col)]; }
    [[nodiscard]] const T& at(std::int32_t row, std::int32_t col) const { return values[index(row, col)]; }
    [[nodiscard]] std::span<T> row(std::int32_t i) {
        return {values.data() + index(i, 0), static_cast<std::size_t>(cols)};
    }
    [[nodiscard]] std::span<const T> row(std::int32_t i) const {
        return {values.data() + index(i, 0), static_cast<std::size_t>(cols)};
    }
};

/// Distance between neighbouring points in metres, along a row (across) and along a column (down).
struct CellSize {
    double across = 1;
    double down = 1;
    double sine = 1;  ///< sine of the angle between these steps: less than 1 if the grid is sheared

    [[nodiscard]] double area() const { return across * down * sine; }
};

/// Elevations or heights in metres; NaN if a point is not valid.
using MetreGrid = Grid<float>;

/// Grid of 1 in selected cells, otherwise 0.
using Mask = Grid<std::uint8_t>;

}  // namespace d2b
