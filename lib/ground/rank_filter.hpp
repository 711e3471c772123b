#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::ground {

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

/// Called with each row just written, while it is in the L1 cache.
template <typename T>
using RowCallback = std::function<void(std::span<T>)>;

/// Fuses two passes, so that a grid passes the caches once: one extremum along lines, then the opposite one
/// on its result, of which only some rows exist at a time. Not for lines along rows.
/// @param between called with each row of the first pass @param after called with each row of `into`
void double_rank_filter(const Grid<float>& from, Grid<float>& into, Line line, Extremum first,
                        std::int32_t radius, const RowCallback<float>& between,
                        const RowCallback<float>& after);
void double_rank_filter(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum first,
                        std::int32_t radius, const RowCallback<std::int16_t>& between,
                        const RowCallback<std::int16_t>& after);

/// Returns the minimum of each cell and its eight neighbours.
[[nodiscard]] MetreGrid minimum_3x3(const MetreGrid& grid, Executor& threads);

/// RowView of a grid, or a ring buffer with space for `held` of them.
template <typename T>
struct RowView {
    T* values = nullptr;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::int32_t held = 0;

    [[nodiscard]] T* row(std::int32_t i) const {
        return values + static_cast<std::ptrdiff_t>(i % held) * cols;
    }
    [[nodiscard]] RowView<const T> read() const { return {values, rows, cols, held}; }
};

template <typename T>
[[nodiscard]] RowView<T> view_rows(Grid<T>& grid) {
    return {grid.values.data(), grid.rows, grid.cols, grid.rows};
}
template <typename T>
[[nodiscard]] RowView<const T> view_rows(const Grid<T>& grid) {
    return {grid.values.data(), grid.rows, grid.cols, grid.rows};
}

inline constexpr std::int32_t max_small_radius = 3;

/// Extrema of lines of 2 * radius + 1 cells along rows or down columns, computed cell by cell, because for
/// short lines that takes fewer steps than sharing work between lines.
template <typename Pick, std::int32_t radius, typename T>
class SmallWindowFilter {
  public:
    /// @param out row other than `in`
    static void filter_row(const T* in, std::int32_t cols, T* out) {
        const std::int32_t inner = std::max(cols - radius, radius);
        for (std::int32_t j = radius; j < inner; ++j)
            out[j] = picked([&](std::int32_t k) { return in[j + k]; });
        // Beyond an end, repeats the cell at that end, because it does not change the extremum of a line that
        // contains it.
        const auto at_end = [&](std::int32_t j) {
            out[j] = picked([&](std::int32_t k) { return in[std::clamp(j + k, 0, cols - 1)]; });
        };
        for (std::int32_t j = 0; j < std::min(radius, cols); ++j)
            at_end(j);
        for (std::int32_t j = inner; j < cols; ++j)
            at_end(j);
    }

    /// Computes one row. @param out row of the same length
    static void filter_columns(const RowView<const T>& from, std::int32_t i, T* out) {
        across(from, i, out, std::make_integer_sequence<std::int32_t, radius>());
    }

  private:
    template <std::int32_t... k>
    static void across(const RowView<const T>& from, std::int32_t i, T* out,
                       std::integer_sequence<std::int32_t, k...> /*rows*/) {
        const auto row = [&](std::int32_t r) { return from.row(std::clamp(r, 0, from.rows - 1)); };
        down(from.cols, out, row(i), row(i - 1 - k)..., row(i + 1 + k)...);
    }
    template <typename... Row>
    static void down(std::int32_t cols, T* out, const T* here, Row... rows) {
        [[maybe_unused]] const Pick pick;
        for (std::int32_t j = 0; j < cols; ++j) {
            T found = here[j];
            ((found = pick(rows[j], found)), ...);
            out[j] = found;
        }
    }
    template <typename Value>
    static T picked(const Value& value) {
        const Pick pick;
        T found = value(0);
        for (std::int32_t k = 1; k <= radius; ++k)
            found = pick(pick(value(-k), value(k)), found);
        return found;
    }
};

/// Buffers reused between rows.
template <typename T>
struct RowBuffers {
    std::vector<T> padded;
    std::vector<T> doubled;
};

/// Computes extrema of 2, 4, 8, ... cells by doubling; the last two lines overlap.
template <typename Pick, typename T>
void filter_row_by_doubling(const T* in, std::size_t cols, std::size_t reach, RowBuffers<T>& buffers,
                            T* out) {
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

/// Computes the extremum of each line of 2 * radius + 1 cells along a row. @param out row other than `in`
template <typename Pick, std::int32_t small_radius = max_small_radius, typename T>
void filter_row(const T* in, std::int32_t cols, std::int32_t radius, RowBuffers<T>& buffers, T* out) {
    if (radius > max_small_radius)
        return filter_row_by_doubling<Pick>(in, static_cast<std::size_t>(cols),
                                            static_cast<std::size_t>(radius), buffers, out);
    if constexpr (small_radius > 0)
        if (radius < small_radius)
            return filter_row<Pick, small_radius - 1>(in, cols, radius, buffers, out);
    SmallWindowFilter<Pick, small_radius, T>::filter_row(in, cols, out);
}

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

/// Sliding minimum or maximum by van Herk (1992) and Gil and Werman (1993) on whole rows: lines run down,
/// `shift` columns per row. Blocks as long as a line are processed from the first row to the last.
template <typename Pick, typename T>
class VanHerkFilter {
  public:
    VanHerkFilter(RowView<const T> from, RowView<T> into, std::int32_t radius, std::int32_t shift)
        : from_(from), into_(into), radius_(radius), shift_(shift) {}

    /// Processes the grid in strips of columns whose rows stay in the cache.
    void run() {
        constexpr std::int32_t strip = 2048;
        for (std::int32_t first = 0; first < from_.cols; first += strip) {
            begin(first, std::min(first + strip, from_.cols));
            for (std::int32_t top = 0; top < from_.rows; top += length())
                block(top, {});
        }
    }

    [[nodiscard]] std::int32_t length() const { return 2 * radius_ + 1; }

    /// Starts a range of columns before its first block.
    void begin(std::int32_t first, std::int32_t last) {
        margin_ = shift_ == 0 ? 0 : radius_;
        first_ = first - margin_;
        last_ = last;
        cols_ = last - first + 2 * margin_;
        suffix_.assign(static_cast<std::size_t>(length()) * static_cast<std::size_t>(cols_),
                       Pick::template neutral<T>);
        prefix_.assign(static_cast<std::size_t>(cols_), Pick::template neutral<T>);
        other_ = prefix_;
    }

    /// Processes the block of rows from `top` on. Reads `radius` more rows on both sides.
    /// @param after called with the columns of each row
    void block(std::int32_t top, const RowCallback<T>& after) {
        fill_suffixes(top);
        std::fill(prefix_.begin(), prefix_.end(), Pick::template neutral<T>);
        for (std::int32_t k = 0; k < length() && top + k < from_.rows; ++k) {
            if (k > 0) {
                extend(prefix_.data(), other_.data(), top + radius_ + k, -shift_);
                prefix_.swap(other_);
            }
            const std::span<T> row = write(top + k, k);
            if (after)
                after(row);
        }
    }

  private:
    T* suffix(std::int32_t k) { return suffix_.data() + static_cast<std::ptrdiff_t>(k) * cols_; }

    /// Fills suffix k: extrema of lines from row top - radius + k to the last row of the block, top + radius.
    void fill_suffixes(std::int32_t top) {
        std::fill(other_.begin(), other_.end(), Pick::template neutral<T>);
        extend(other_.data(), suffix(2 * radius_), top + radius_, shift_);
        for (std::int32_t k = 2 * radius_ - 1; k >= 0; --k)
            extend(suffix(k + 1), suffix(k), top - radius_ + k, shift_);
    }

    /// Extends lines that end in the previous (or next) row by one row, shifted by `step` columns.
    void extend(const T* old, T* out, std::int32_t row, std::int32_t step) {
        const std::int32_t begin = std::max(0, -step);
        const std::int32_t end = cols_ - std::max(0, step);
        if (row < 0 || row >= from_.rows) {
            std::copy(old + begin + step, old + end + step, out + begin);
            std::fill(out, out + begin, Pick::template neutral<T>);
            std::fill(out + end, out + cols_, Pick::template neutral<T>);
            return;
        }
        // Cells outside of the grid are neutral, so lines there are copied.
        const std::int32_t grid_begin = std::clamp(-first_, begin, end);
        const std::int32_t grid_end = std::clamp(from_.cols - first_, grid_begin, end);
        const T* cells = from_.row(row);
        const Pick pick;
        std::copy(old + begin + step, old + grid_begin + step, out + begin);
        for (std::int32_t j = grid_begin; j < grid_end; ++j)
            out[j] = pick(cells[first_ + j], old[j + step]);
        std::copy(old + grid_end + step, old + end + step, out + grid_end);
        for (std::int32_t j = 0; j < begin; ++j)
            out[j] = of_row(cells, j);
        for (std::int32_t j = end; j < cols_; ++j)
            out[j] = of_row(cells, j);
    }

    /// Value of a row in one of the strip's columns, neutral outside of the grid.
    [[nodiscard]] T of_row(const T* cells, std::int32_t j) const {
        const std::int32_t col = first_ + j;
        return col >= 0 && col < from_.cols ? cells[col] : Pick::template neutral<T>;
    }

    std::span<T> write(std::int32_t row, std::int32_t k) {
        const std::int32_t aside = shift_ * radius_;
        const std::int32_t count = cols_ - 2 * margin_;
        const T* behind = suffix(k) + (margin_ - aside);
        const T* ahead = prefix_.data() + (margin_ + aside);
        T* out = into_.row(row) + (last_ - count);
        const Pick pick;
        for (std::int32_t j = 0; j < count; ++j)
            out[j] = pick(behind[j], ahead[j]);
        return {out, static_cast<std::size_t>(count)};
    }

    RowView<const T> from_;
    RowView<T> into_;
    std::int32_t radius_;
    std::int32_t shift_;
    std::int32_t margin_ = 0;
    std::int32_t first_ = 0;  ///< first column of the strip, including its margin
    std::int32_t last_ = 0;   ///< one past the last column of the strip, without margin
    std::int32_t cols_ = 0;
    std::vector<T> suffix_, prefix_, other_;
};

[[nodiscard]] constexpr std::int32_t shift_of(Line line) {
    return line == Line::column ? 0 : (line == Line::right_diagonal ? 1 : -1);
}

/// Calls use() with the SmallWindowFilter of a radius.
template <typename Pick, typename T, std::int32_t radius = max_small_radius, typename Use>
void with_small_window(std::int32_t wanted, const Use& use) {
    if constexpr (radius > 0)
        if (wanted < radius)
            return with_small_window<Pick, T, radius - 1>(wanted, use);
    use(SmallWindowFilter<Pick, radius, T>());
}

template <typename Pick, typename T>
void filter(const Grid<T>& from, Grid<T>& into, Line line, std::int32_t radius) {
    if (line == Line::row) {
        RowBuffers<T> buffers;
        for (std::int32_t i = 0; i < from.rows; ++i)
            filter_row<Pick>(from.row(i).data(), from.cols, radius, buffers, into.row(i).data());
    } else if (line == Line::column && radius <= max_small_radius) {
        with_small_window<Pick, T>(radius, [&](const auto& narrow) {
            for (std::int32_t i = 0; i < from.rows; ++i)
                narrow.filter_columns(view_rows(from), i, into.row(i).data());
        });
    } else {
        VanHerkFilter<Pick, T>(view_rows(from), view_rows(into), radius, shift_of(line)).run();
    }
}

/// Implements rank_filter(), to be compiled for several processors.
template <typename T>
void rank_filter_impl(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        filter<Minimum>(from, into, line, radius);
    else
        filter<Maximum>(from, into, line, radius);
}

/// @param ring for rows of the first pass
template <typename First, typename Second, typename T>
void small_window_double_filter(const Grid<T>& from, Grid<T>& into, std::int32_t radius,
                                const RowView<T>& ring, const RowCallback<T>& between,
                                const RowCallback<T>& after) {
    const auto cols = static_cast<std::size_t>(from.cols);
    std::int32_t done = 0;
    for (std::int32_t i = 0; i < from.rows; ++i) {
        for (; done < std::min(i + radius + 1, from.rows); ++done) {
            T* row = ring.row(done);
            with_small_window<First, T>(
                radius, [&](const auto& narrow) { narrow.filter_columns(view_rows(from), done, row); });
            between({row, cols});
        }
        with_small_window<Second, T>(
            radius, [&](const auto& narrow) { narrow.filter_columns(ring.read(), i, into.row(i).data()); });
        if (after)
            after(into.row(i));
    }
}

template <typename First, typename Second, typename T>
void van_herk_double_filter(const Grid<T>& from, Grid<T>& into, std::int32_t radius, std::int32_t shift,
                            const RowView<T>& ring, const RowCallback<T>& between,
                            const RowCallback<T>& after) {
    VanHerkFilter<First, T> first(view_rows(from), ring, radius, shift);
    VanHerkFilter<Second, T> second(ring.read(), view_rows(into), radius, shift);
    first.begin(0, from.cols);
    second.begin(0, from.cols);
    std::int32_t done = 0;
    for (std::int32_t top = 0; top < from.rows; top += second.length()) {
        for (; done < std::min(top + second.length() + radius, from.rows); done += first.length())
            first.block(done, between);
        second.block(top, after);
    }
}

/// Implements double_rank_filter().
template <typename T>
void double_rank_filter_impl(const Grid<T>& from, Grid<T>& into, Line line, Extremum which,
                             std::int32_t radius, const RowCallback<T>& between,
                             const RowCallback<T>& after) {
    const std::int32_t held = std::min(3 * (2 * radius + 1), from.rows);
    std::vector<T> values(static_cast<std::size_t>(held) * static_cast<std::size_t>(from.cols));
    const RowView<T> ring{values.data(), from.rows, from.cols, held};
    const bool lowest = which == Extremum::lowest;
    if (line == Line::column && radius <= max_small_radius)
        lowest ? small_window_double_filter<Minimum, Maximum>(from, into, radius, ring, between, after)
               : small_window_double_filter<Maximum, Minimum>(from, into, radius, ring, between, after);
    else
        lowest ? van_herk_double_filter<Minimum, Maximum>(from, into, radius, shift_of(line), ring, between,
                                                          after)
               : van_herk_double_filter<Maximum, Minimum>(from, into, radius, shift_of(line), ring, between,
                                                          after);
}

}  // namespace d2b::ground
