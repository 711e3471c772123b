#include "raster/rank_filter.hpp"

#include <span>

namespace d2b {
namespace {

/// Sliding minimum or maximum by van Herk (1992) and Gil and Werman (1993) on whole rows: lines run down,
/// `shift` columns per row. Blocks as long as a line are processed from the first row to the last.
template <typename Pick, typename T>
class VanHerkFilter {
  public:
    VanHerkFilter(const Grid<T>& from, Grid<T>& into, std::int32_t radius, std::int32_t shift)
        : from_(from), into_(into), radius_(radius), shift_(shift) {}

    /// Processes the grid in strips of columns whose rows stay in the cache.
    void run() {
        constexpr std::int32_t strip = 2048;
        for (std::int32_t first = 0; first < from_.cols; first += strip) {
            begin(first, std::min(first + strip, from_.cols));
            for (std::int32_t top = 0; top < from_.rows; top += length())
                block(top);
        }
    }

  private:
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
    void block(std::int32_t top) {
        fill_suffixes(top);
        std::fill(prefix_.begin(), prefix_.end(), Pick::template neutral<T>);
        for (std::int32_t k = 0; k < length() && top + k < from_.rows; ++k) {
            if (k > 0) {
                extend(prefix_.data(), other_.data(), top + radius_ + k, -shift_);
                prefix_.swap(other_);
            }
            write(top + k, k);
        }
    }

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
        const T* cells = from_.row(row).data();
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

    void write(std::int32_t row, std::int32_t k) {
        const std::int32_t aside = shift_ * radius_;
        const std::int32_t count = cols_ - 2 * margin_;
        const T* behind = suffix(k) + (margin_ - aside);
        const T* ahead = prefix_.data() + (margin_ + aside);
        T* out = into_.row(row).data() + (last_ - count);
        const Pick pick;
        for (std::int32_t j = 0; j < count; ++j)
            out[j] = pick(behind[j], ahead[j]);
    }

    const Grid<T>& from_;
    Grid<T>& into_;
    std::int32_t radius_;
    std::int32_t shift_;
    std::int32_t margin_ = 0;
    std::int32_t first_ = 0;  ///< first column of the strip, including its margin
    std::int32_t last_ = 0;   ///< one past the last column of the strip, without margin
    std::int32_t cols_ = 0;
    std::vector<T> suffix_, prefix_, other_;
};

template <typename Pick, typename T>
void filter(const Grid<T>& from, Grid<T>& into, Line line, std::int32_t radius) {
    if (line == Line::row) {
        RowBuffers<T> buffers;
        for (std::int32_t i = 0; i < from.rows; ++i)
            filter_row<Pick>(from.row(i).data(), static_cast<std::size_t>(from.cols),
                             static_cast<std::size_t>(radius), buffers, into.row(i).data());
    } else {
        const std::int32_t shift = line == Line::column ? 0 : (line == Line::right_diagonal ? 1 : -1);
        VanHerkFilter<Pick, T>(from, into, radius, shift).run();
    }
}

template <typename T>
void rank_filter_impl(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    if (which == Extremum::lowest)
        filter<Minimum>(from, into, line, radius);
    else
        filter<Maximum>(from, into, line, radius);
}

/// Computes the minimum of each cell of a row and its eight neighbours.
/// @param column buffer for a row
void minimum_3x3_row(const MetreGrid& grid, std::int32_t row, std::vector<float>& column,
                     std::span<float> lowest) {
    const Minimum lower;
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

D2B_MULTIVERSION void rank_filter(const Grid<float>& from, Grid<float>& into, Line line, Extremum which,
                                  std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

D2B_MULTIVERSION void rank_filter(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line,
                                  Extremum which, std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
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

}  // namespace d2b
