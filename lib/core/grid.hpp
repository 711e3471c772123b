#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/block_pool.hpp"
#include "core/executor.hpp"

namespace d2b {

/// Values of cells. Those that are not set when it grows are whatever its memory held.
template <typename T>
using CellValues = std::vector<T, CellMemory<T>>;

template <typename T>
[[nodiscard]] bool operator==(const CellValues<T>& one, const std::vector<T>& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

/// Values of a window, row by row: what stages with a neighbourhood work on. (0, 0) is the window's first
/// cell.
template <typename T>
struct Grid {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    CellValues<T> values;

    Grid() = default;
    Grid(std::int32_t row_count, std::int32_t col_count, T value = T{}) : rows(row_count), cols(col_count) {
        values.resize(index(rows, 0), value);
    }
    /// The same sooner, in memory that other grids of these threads gave back.
    Grid(std::int32_t row_count, std::int32_t col_count, T value, Executor& threads)
        : Grid(unset(row_count, col_count, threads)) {
        constexpr std::size_t piece = 1 << 20;
        threads.for_pieces(values.size(), piece, [&](std::size_t begin, std::size_t end) {
            std::fill(values.data() + begin, values.data() + end, value);
        });
    }
    /// For those who set all values: they are whatever the memory held.
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

/// How far apart neighbouring points are, in metres: one step of a column and one of a row.
struct CellSize {
    double across = 1;
    double down = 1;
    double sine = 1;  ///< of the angle between these steps: less than 1 where the grid is sheared

    [[nodiscard]] double area() const { return across * down * sine; }
};

/// Elevations or heights in metres, NaN where a point is not valid.
using MetreGrid = Grid<float>;

/// 1 where something holds, 0 elsewhere.
using Mask = Grid<std::uint8_t>;

}  // namespace d2b
