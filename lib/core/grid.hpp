#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/block_pool.hpp"
#include "core/executor.hpp"
#include "core/system/multiversion.hpp"  // IWYU pragma: export

namespace d2b {

/// Calls use(begin, end, value) for each run of equal nonzero cells of a row.
template <typename Row, typename Use>
void for_equal_runs(const Row& row, const Use& use) {
    for (std::size_t begin = 0; begin < row.size();) {
        const auto value = row[begin];
        std::size_t end = begin + 1;
        while (end < row.size() && row[end] == value)
            ++end;
        if (value != 0)
            use(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), value);
        begin = end;
    }
}

/// Values of cells. resize() without a value leaves new ones uninitialised.
template <typename T>
using CellValues = std::vector<T, CellAllocator<T>>;

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
        threads.for_chunks(values.size(), piece, [&](std::size_t begin, std::size_t end) {
            std::fill(values.data() + begin, values.data() + end, value);
        });
    }
    /// Returns a grid with uninitialised values, for callers that set all of them.
    [[nodiscard]] static Grid unset(std::int32_t row_count, std::int32_t col_count, Executor& threads) {
        Grid grid;
        grid.rows = row_count;
        grid.cols = col_count;
        grid.values = CellValues<T>(CellAllocator<T>(threads.blocks()));
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
    double sine = 1;    ///< sine of the angle between these steps: less than 1 if the grid is sheared
    double cosine = 0;  ///< its cosine: below 0 if the steps point away from each other

    [[nodiscard]] double area() const { return across * down * sine; }
};

/// Elevations or heights in metres; NaN if a point is not valid.
using MetreGrid = Grid<float>;

/// Grid of 1 in selected cells, otherwise 0.
using Mask = Grid<std::uint8_t>;

/// Rows [begin, end) of a grid.
struct RowBand {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

/// Divides a grid into bands of some 256 Ki cells for threads, because a band then stays in the cache. The
/// bands depend only on the shape of the grid. @param least minimum number of rows of a band: many if a band
/// starts with work on the rows around it
[[nodiscard]] inline std::vector<RowBand> row_bands(std::int32_t rows, std::int32_t cols,
                                                    std::int32_t least = 16) {
    constexpr std::int32_t cells = 1 << 18;
    const std::int32_t height = std::clamp(cells / std::max(cols, 1), least, std::max(least, 1024));
    std::vector<RowBand> bands;
    for (std::int32_t begin = 0; begin < rows; begin += height)
        bands.push_back({begin, std::min(begin + height, rows)});
    return bands;
}

/// Calls work(band) for all bands of a grid, on all threads.
template <typename Work>
void for_row_bands(Executor& threads, std::int32_t rows, std::int32_t cols, const Work& work,
                   std::int32_t least = 16) {
    const std::vector<RowBand> bands = row_bands(rows, cols, least);
    threads.for_each(bands.size(), [&](std::size_t i) { work(bands[i]); });
}

/// Reduces over all bands of a grid, on all threads: merges the results of work(band, sum). Bands are merged
/// in any order, so merging must be commutative. @param nothing initial value per band; Sum has merge(const
/// Sum&)
template <typename Sum, typename Work>
[[nodiscard]] Sum reduce_row_bands(Executor& threads, std::int32_t rows, std::int32_t cols,
                                   const Sum& nothing, const Work& work) {
    Sum all = nothing;
    std::mutex mutex;
    for_row_bands(threads, rows, cols, [&](RowBand band) {
        Sum some = nothing;
        work(band, some);
        const std::lock_guard lock(mutex);
        all.merge(some);
    });
    return all;
}

/// Calls work(row) for all rows of a grid, on all threads.
template <typename Work>
void for_rows(Executor& threads, std::int32_t rows, std::int32_t cols, const Work& work) {
    for_row_bands(threads, rows, cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            work(r);
    });
}

/// Same as reduce_row_bands(), with work(row, sum).
template <typename Sum, typename Work>
[[nodiscard]] Sum reduce_rows(Executor& threads, std::int32_t rows, std::int32_t cols, const Sum& nothing,
                              const Work& work) {
    return reduce_row_bands(threads, rows, cols, nothing, [&](RowBand band, Sum& sum) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            work(r, sum);
    });
}

/// Calls work(begin, end) with the cell indices of each band of a grid, on all threads.
template <typename T, typename Work>
void for_cells(Executor& threads, const Grid<T>& grid, const Work& work) {
    for_row_bands(threads, grid.rows, grid.cols,
                  [&](RowBand band) { work(grid.index(band.begin, 0), grid.index(band.end, 0)); });
}

/// Copy of a band with unmodified rows of its neighbours (a halo).
template <typename T>
struct HaloBand {
    RowBand band;
    std::int32_t first = 0;  ///< row of the grid that is row 0 of the copy
    Grid<T> rows;

    /// Copies rows [begin, end) of the grid, clipped to it.
    void copy(const Grid<T>& grid, std::int32_t begin, std::int32_t end) {
        first = std::max(begin, 0);
        rows.rows = std::min(end, grid.rows) - first;
        rows.cols = grid.cols;
        rows.values.assign(grid.row(first).data(), grid.row(first).data() + grid.index(rows.rows, 0));
    }
    /// Copies the rows common to both.
    void take_rows(const HaloBand& other) {
        const std::int32_t begin = std::max(first, other.first);
        const std::int32_t end = std::min(first + rows.rows, other.first + other.rows.rows);
        if (begin < end)
            std::copy_n(other.rows.row(begin - other.first).data(), rows.index(end - begin, 0),
                        rows.row(begin - first).data());
    }
    void write_band(Grid<T>& grid) const {
        std::copy_n(rows.row(band.begin - first).data(), rows.index(band.end - band.begin, 0),
                    grid.row(band.begin).data());
    }
};

/// Calls work(HaloBand&) for all bands of a grid, on all threads, for filters that work in place. Each copy
/// includes `reach` unmodified rows of the neighbouring bands, so work() may change the rows of its band in
/// the grid.
template <typename T, typename Work>
void for_bands_with_halo(Executor& threads, const Grid<T>& grid, std::int32_t reach, const Work& work) {
    const std::vector<RowBand> bands = row_bands(grid.rows, grid.cols);
    std::vector<HaloBand<T>> seams(
        bands.size());  // rows around the boundary between a band and the previous one
    threads.for_each(bands.size(), [&](std::size_t i) {
        seams[i].copy(grid, bands[i].begin - reach, bands[i].begin + reach);
    });
    threads.for_each_with_scratch<HaloBand<T>>(bands.size(), [&](std::size_t i, HaloBand<T>& copy) {
        copy.band = bands[i];
        copy.first = std::max(bands[i].begin - reach, 0);
        copy.rows.rows = std::min(bands[i].end + reach, grid.rows) - copy.first;
        copy.rows.cols = grid.cols;
        copy.rows.values.resize(copy.rows.index(copy.rows.rows, 0));
        std::copy_n(grid.row(bands[i].begin).data(), grid.index(bands[i].end - bands[i].begin, 0),
                    copy.rows.row(bands[i].begin - copy.first).data());
        copy.take_rows(seams[i]);
        if (i + 1 < bands.size())
            copy.take_rows(seams[i + 1]);
        work(copy);
    });
}

}  // namespace d2b
