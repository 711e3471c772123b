#pragma once

#include <cstddef>
#include <cstdint>

#include "core/grid.hpp"

namespace d2b::ground {

/// Rows of a grid, or a ring buffer with space for `held` of them.
template <typename T>
struct Rows {
    T* values = nullptr;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::int32_t held = 0;

    [[nodiscard]] T* row(std::int32_t i) const {
        return values + static_cast<std::ptrdiff_t>(i % held) * cols;
    }
    [[nodiscard]] Rows<const T> read() const { return {values, rows, cols, held}; }
};

template <typename T>
[[nodiscard]] Rows<T> rows_of(Grid<T>& grid) {
    return {grid.values.data(), grid.rows, grid.cols, grid.rows};
}
template <typename T>
[[nodiscard]] Rows<const T> rows_of(const Grid<T>& grid) {
    return {grid.values.data(), grid.rows, grid.cols, grid.rows};
}

}  // namespace d2b::ground
