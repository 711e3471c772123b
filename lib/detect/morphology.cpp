#include "detect/morphology.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

/// A row of cells with all cells from so many to the left to so many to the right of them set. It is narrowed
/// further from one row of the element to the next.
class NarrowedRow {
  public:
    NarrowedRow(std::int32_t cols, std::int32_t beside)
        : beside_(beside),
          padded_(static_cast<std::size_t>(cols + 2 * beside)),
          cells_(static_cast<std::size_t>(cols)) {}

    /// The row's ends continue outwards.
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

/// Rows of the result that see row `from` through a row of the element: one, or where rows beyond the border
/// are like the last, more.
void take_row(Mask& result, std::int32_t from, std::int32_t down, std::span<const std::uint8_t> cells) {
    const std::int32_t last = result.rows - 1;
    const std::int32_t begin = from == 0 ? 0 : std::max(0, from - down);
    const std::int32_t end = from == last ? last : std::min(last, from - down);
    for (std::int32_t r = begin; r <= end; ++r) {
        if (std::clamp(r + down, 0, last) != from)
            continue;
        const std::span<std::uint8_t> out = result.row(r);
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c] &= cells[c];
    }
}

Mask eroded(const Mask& mask, Element element) {
    Mask result(mask.rows, mask.cols, 1);
    if (mask.size() == 0)
        return result;
    std::stable_sort(element.begin(), element.end(), [](const ElementRow& a, const ElementRow& b) {
        return a.right - a.left < b.right - b.left;
    });
    NarrowedRow row(mask.cols, columns_beside(element));
    for (std::int32_t from = 0; from < mask.rows; ++from) {
        row.set(mask.row(from));
        for (const ElementRow& part : element) {
            row.narrow(part.left, part.right);
            take_row(result, from, part.down, row.cells());
        }
    }
    return result;
}

void turn(Mask& mask) {
    for (std::uint8_t& value : mask.values)
        value ^= 1;
}

}  // namespace

Mask opened(Mask mask, double radius_m, const CellSize& cell) {
    const Element element = disk_element(radius_m, cell);
    mask = eroded(mask, element);
    turn(mask);
    mask = eroded(mask, turned_over(element));  // of what is outside: a dilation
    turn(mask);
    return mask;
}

Mask grown(Mask mask, const Mask& within, int steps) {
    // Rows as they were: the one above and this one, with a zero at each end.
    const auto cols = static_cast<std::size_t>(mask.cols);
    std::vector<std::uint8_t> up(cols + 2);
    std::vector<std::uint8_t> here(cols + 2);
    for (int step = 0; step < steps; ++step) {
        std::fill(up.begin(), up.end(), std::uint8_t{0});
        for (std::int32_t r = 0; r < mask.rows; ++r) {
            const std::span<std::uint8_t> out = mask.row(r);
            const std::span<const std::uint8_t> may = within.row(r);
            const std::span<const std::uint8_t> down = mask.row(std::min(r + 1, mask.rows - 1));
            std::copy(out.begin(), out.end(), here.begin() + 1);
            for (std::size_t c = 0; c < cols; ++c)
                out[c] = here[c + 1] | (may[c] & (up[c + 1] | down[c] | here[c] | here[c + 2]));
            up.swap(here);
        }
    }
    return mask;
}

}  // namespace d2b
