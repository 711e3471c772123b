#include "detect/morphology.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/processors.hpp"
#include "core/row_bands.hpp"
#include "detect/element.hpp"

namespace d2b {
namespace {

Element turned_over(const Element& element) {
    Element result;
    for (const ElementRow& row : element)
        result.push_back({-row.down, -row.right, -row.left});
    return result;
}

std::int32_t columns_beside(const Element& element) {
    std::int32_t result = 0;
    for (const ElementRow& row : element)
        result = std::max({result, -row.left, row.right});
    return result;
}

/// Cells of a row whose neighbours in columns [c - left, c + right] are all set. The interval grows from one
/// row of the structuring element to the next.
class NarrowedRow {
  public:
    NarrowedRow(std::int32_t cols, std::int32_t beside)
        : beside_(beside),
          padded_(static_cast<std::size_t>(cols + 2 * beside)),
          cells_(static_cast<std::size_t>(cols)) {}

    /// Replicates the border cells outwards.
    void set(std::span<const std::uint8_t> row) {
        std::copy(row.begin(), row.end(), padded_.begin() + beside_);
        std::fill_n(padded_.begin(), beside_, row.front());
        std::fill_n(padded_.end() - beside_, beside_, row.back());
        std::copy(row.begin(), row.end(), cells_.begin());
        left_ = right_ = 0;
    }
    void narrow(std::int32_t left, std::int32_t right) {
        while (left_ > left)
            take(--left_);
        while (right_ < right)
            take(++right_);
    }
    [[nodiscard]] std::span<const std::uint8_t> cells() const { return cells_; }

  private:
    void take(std::int32_t offset) {
        const std::uint8_t* const from = padded_.data() + beside_ + offset;
        for (std::size_t c = 0; c < cells_.size(); ++c)
            cells_[c] &= from[c];
    }

    std::int32_t beside_;
    std::int32_t left_ = 0;
    std::int32_t right_ = 0;
    std::vector<std::uint8_t> padded_;
    std::vector<std::uint8_t> cells_;
};

/// Updates the rows of a band that see row `from` through one row of the element: a single row, or several at
/// the border, because the border row is replicated.
void take_row(Mask& result, RowBand band, std::int32_t from, std::int32_t down,
              std::span<const std::uint8_t> cells) {
    const std::int32_t last = result.rows - 1;
    const std::int32_t begin = std::max(from == 0 ? 0 : from - down, band.begin);
    const std::int32_t end = std::min(from == last ? last : from - down, band.end - 1);
    for (std::int32_t r = begin; r <= end; ++r) {
        if (std::clamp(r + down, 0, last) != from)
            continue;
        const std::span<std::uint8_t> out = result.row(r);
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c] &= cells[c];
    }
}

/// Computes, for a band, the cells at which the element does not fit into the mask.
/// @param element rows sorted from the shortest to the longest
D2B_FOR_EACH_PROCESSOR void rest_of_band(const Mask& mask, const Element& element, std::int32_t reach,
                                         RowBand band, Mask& result) {
    std::fill(result.row(band.begin).begin(), result.row(band.end - 1).end(), std::uint8_t{1});
    NarrowedRow row(mask.cols, columns_beside(element));
    const std::int32_t end = std::min(band.end + reach, mask.rows);
    for (std::int32_t from = std::max(band.begin - reach, 0); from < end; ++from) {
        row.set(mask.row(from));
        for (const ElementRow& part : element) {
            row.narrow(part.left, part.right);
            take_row(result, band, from, part.down, row.cells());
        }
    }
    for (std::size_t i = result.index(band.begin, 0); i < result.index(band.end, 0); ++i)
        result.values[i] ^= 1;
}

Mask rest_of_erosion(const Mask& mask, Element element, Executor& threads) {
    std::stable_sort(element.begin(), element.end(), [](const ElementRow& a, const ElementRow& b) {
        return a.right - a.left < b.right - b.left;
    });
    std::int32_t reach = 0;
    for (const ElementRow& row : element)
        reach = std::max(reach, std::abs(row.down));
    Mask result = Mask::unset(mask.rows, mask.cols, threads);
    const std::int32_t least = 8 * std::min(reach, mask.rows);  // bands read `reach` rows above and below
    for_row_bands(
        threads, mask.rows, mask.cols,
        [&](RowBand band) { rest_of_band(mask, element, reach, band, result); }, std::max(least, 16));
    return result;
}

/// Conditional dilation of a copy of a band, one step at a time. Rows at the ends of the copy become invalid.
D2B_FOR_EACH_PROCESSOR void grow_copy(BandCopy<std::uint8_t>& copy, const Mask& within, int steps) {
    // Previous values of the row above and of this row, with a zero at each end.
    Mask& mask = copy.rows;
    const auto cols = static_cast<std::size_t>(mask.cols);
    std::vector<std::uint8_t> up(cols + 2);
    std::vector<std::uint8_t> here(cols + 2);
    for (int step = 0; step < steps; ++step) {
        std::fill(up.begin(), up.end(), std::uint8_t{0});
        for (std::int32_t r = 0; r < mask.rows; ++r) {
            const std::span<std::uint8_t> out = mask.row(r);
            const std::span<const std::uint8_t> may = within.row(copy.first + r);
            const std::span<const std::uint8_t> down = mask.row(std::min(r + 1, mask.rows - 1));
            std::copy(out.begin(), out.end(), here.begin() + 1);
            for (std::size_t c = 0; c < cols; ++c)
                out[c] = here[c + 1] | (may[c] & (up[c + 1] | down[c] | here[c] | here[c + 2]));
            up.swap(here);
        }
    }
}

}  // namespace

Mask eroded(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads) {
    Mask result = rest_of_erosion(mask, disk_element(radius_m, cell), threads);
    for_row_bands(threads, result.rows, result.cols, [&](RowBand band) {
        for (std::size_t i = result.index(band.begin, 0); i < result.index(band.end, 0); ++i)
            result.values[i] ^= 1;
    });
    return result;
}

Mask opened(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads) {
    const Element element = disk_element(radius_m, cell);
    // A dilation is the complement of an erosion of the complement.
    return rest_of_erosion(rest_of_erosion(mask, element, threads), turned_over(element), threads);
}

Mask grown(Mask mask, const Mask& within, int steps, Executor& threads) {
    for_band_copies(threads, mask, steps, [&](BandCopy<std::uint8_t>& copy) {
        grow_copy(copy, within, steps);
        copy.write_band(mask);
    });
    return mask;
}

}  // namespace d2b
