#include "raster/morphology.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "raster/rank_filter.hpp"
#include "raster/regions.hpp"

namespace d2b {

namespace {

// Tolerance, because 1.5 m have to be exactly three cells of 0.5 m.
constexpr double hair = 1 + 1e-9;

Element reflected(const Element& element) {
    Element result;
    for (const ElementRow& row : element)
        result.push_back({-row.down, -row.right, -row.left});
    return result;
}

std::int32_t max_column_offset(const Element& element) {
    std::int32_t result = 0;
    for (const ElementRow& row : element)
        result = std::max({result, -row.left, row.right});
    return result;
}

/// Cells of a row whose neighbours in columns [c - left, c + right] are all set. The interval grows from one
/// row of the structuring element to the next.
class ErodedRow {
  public:
    ErodedRow(std::int32_t cols, std::int32_t beside)
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
D2B_MULTIVERSION void complement_of_eroded_band(const Mask& mask, const Element& element, std::int32_t reach,
                                                RowBand band, Mask& result) {
    std::fill(result.row(band.begin).begin(), result.row(band.end - 1).end(), std::uint8_t{1});
    ErodedRow row(mask.cols, max_column_offset(element));
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

Mask complement_of_erosion(const Mask& mask, Element element, Executor& threads) {
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
        [&](RowBand band) { complement_of_eroded_band(mask, element, reach, band, result); },
        std::max(least, 16));
    return result;
}

/// Conditional dilation of a copy of a band, one step at a time. Rows at the ends of the copy become invalid.
D2B_MULTIVERSION void grow_copy(HaloBand<std::uint8_t>& copy, const Mask& within, int steps) {
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

/// Thresholds in per cent: a cell joins if buildings cover more than `gain` of its neighbourhood, and a
/// building cell stays if they cover more than `keep`.
struct MajorityThresholds {
    std::uint32_t gain;
    std::uint32_t keep;
};

constexpr double growth_reach_m = 3.5;
constexpr MajorityThresholds growth_shares{58, 10};
constexpr int growth_rounds = 2;
constexpr double border_reach_m = 1;
constexpr MajorityThresholds border_shares{50, 50};

std::int32_t radius_in_cells(double reach_m, double step, std::int32_t cells) {
    constexpr std::int32_t most =
        3000;  // so that a hundred times the count of a neighbourhood fits into 32 bits
    const double reached = std::round(reach_m / step);
    return std::max(1,
                    static_cast<std::int32_t>(std::min(reached, static_cast<double>(std::min(cells, most)))));
}

/// Counts the set cells of a mask in a sliding window, from sums down the columns and along the row.
class WindowCounts {
  public:
    /// @param first first row that will be requested
    WindowCounts(const Mask& mask, Radius radius, std::int32_t first)
        : mask_(mask),
          radius_(radius),
          columns_(static_cast<std::size_t>(mask.cols + 2 * radius.across), 0),
          sums_(columns_.size() + 1, 0),
          counts_(static_cast<std::size_t>(mask.cols)) {
        for (std::int32_t r = first - radius.down; r < first + radius.down; ++r)
            add_row(r, 1);
    }
    /// Returns the counts around the cells of row `r`, which must follow the last requested row.
    [[nodiscard]] std::span<const std::uint32_t> row(std::int32_t r) {
        add_row(r + radius_.down, 1);
        for (std::size_t c = 0; c < columns_.size(); ++c)
            sums_[c + 1] = sums_[c] + columns_[c];
        const std::size_t width = columns_.size() + 1 - counts_.size();
        for (std::size_t c = 0; c < counts_.size(); ++c)
            counts_[c] = sums_[c + width] - sums_[c];
        add_row(r - radius_.down, -1);
        return counts_;
    }

  private:
    void add_row(std::int32_t r, std::int32_t sign) {
        if (r < 0 || r >= mask_.rows)
            return;
        const std::span<const std::uint8_t> cells = mask_.row(r);
        std::uint32_t* const columns = columns_.data() + radius_.across;
        for (std::size_t c = 0; c < cells.size(); ++c)
            columns[c] += static_cast<std::uint32_t>(sign * cells[c]);
    }

    const Mask& mask_;
    Radius radius_;
    std::vector<std::uint32_t>
        columns_;                      ///< set cells per column of the window's rows; zeros beyond the mask
    std::vector<std::uint32_t> sums_;  ///< set cells in the columns before
    std::vector<std::uint32_t> counts_;
};

D2B_MULTIVERSION void vote(const Mask& now, const Mask& voters, const Mask& within, Radius radius,
                           MajorityThresholds thresholds, RowBand band, Mask& next) {
    WindowCounts building_counts(now, radius, band.begin);
    WindowCounts voter_counts(voters, radius, band.begin);
    for (std::int32_t r = band.begin; r < band.end; ++r) {
        const std::span<const std::uint32_t> buildings = building_counts.row(r);
        const std::span<const std::uint32_t> all = voter_counts.row(r);
        const std::span<const std::uint8_t> is = now.row(r);
        const std::span<const std::uint8_t> may = within.row(r);
        const std::span<std::uint8_t> out = next.row(r);
        for (std::size_t c = 0; c < out.size(); ++c) {
            const std::uint32_t share = is[c] != 0 ? thresholds.keep : thresholds.gain;
            out[c] = may[c] & (100 * buildings[c] > share * all[c] ? 1 : 0);
        }
    }
}

/// @param voters cells that vote @param within cells that may become building
Mask majority_filter(const Mask& now, const Mask& voters, const Mask& within, double reach_m,
                     const CellSize& cell, MajorityThresholds thresholds, Executor& threads) {
    const Radius radius{radius_in_cells(reach_m, cell.down, now.rows),
                        radius_in_cells(reach_m, cell.across, now.cols)};
    Mask next = Mask::unset(now.rows, now.cols, threads);
    // Bands have a minimum height, because each begins by summing up its first neighbourhood.
    const std::int32_t least = 8 * std::min(radius.down, now.rows);
    for_row_bands(
        threads, now.rows, now.cols,
        [&](RowBand band) { vote(now, voters, within, radius, thresholds, band, next); },
        std::max(least, 16));
    return next;
}

}  // namespace

bool disk_fits(double radius_m, const CellSize& cell) {
    return radius_m * hair >= std::max(cell.across, cell.down);
}

Element disk_element(double radius_m, const CellSize& cell) {
    const double radius = radius_m * hair;
    if (!disk_fits(radius_m, cell))
        return {{0, 0, 1}, {1, 0, 1}};
    const auto rows = static_cast<std::int32_t>(radius / cell.down);
    Element element;
    for (std::int32_t r = -rows; r <= rows; ++r) {
        const double y = r * cell.down;
        const auto half = static_cast<std::int32_t>(std::sqrt(radius * radius - y * y) / cell.across);
        element.push_back({r, -half, half});
    }
    return element;
}

Mask erode(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads) {
    Mask result = complement_of_erosion(mask, disk_element(radius_m, cell), threads);
    for_row_bands(threads, result.rows, result.cols, [&](RowBand band) {
        for (std::size_t i = result.index(band.begin, 0); i < result.index(band.end, 0); ++i)
            result.values[i] ^= 1;
    });
    return result;
}

Mask open_mask(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads) {
    const Element element = disk_element(radius_m, cell);
    // A dilation is the complement of an erosion of the complement.
    return complement_of_erosion(complement_of_erosion(mask, element, threads), reflected(element), threads);
}

Mask dilate(const Mask& mask, std::int32_t reach) {
    Mask along(mask.rows, mask.cols);
    Mask dilated(mask.rows, mask.cols);
    const auto spread = [reach](std::int32_t count, const auto& from, const auto& to) {
        std::int32_t since = reach + 1;  // cells since the last one of the mask
        const auto visit = [&](std::int32_t i) {
            since = from(i) != 0 ? 0 : std::min(since, reach) + 1;
            if (since <= reach)
                to(i) = 1;
        };
        for (std::int32_t i = 0; i < count; ++i)
            visit(i);
        since = reach + 1;
        for (std::int32_t i = count; i-- > 0;)
            visit(i);
    };
    for (std::int32_t row = 0; row < mask.rows; ++row)
        spread(
            mask.cols, [&](std::int32_t i) { return mask.at(row, i); },
            [&](std::int32_t i) -> std::uint8_t& { return along.at(row, i); });
    for (std::int32_t col = 0; col < mask.cols; ++col)
        spread(
            mask.rows, [&](std::int32_t i) { return along.at(i, col); },
            [&](std::int32_t i) -> std::uint8_t& { return dilated.at(i, col); });
    return dilated;
}

Mask dilate_within(Mask mask, const Mask& within, int steps, Executor& threads) {
    for_bands_with_halo(threads, mask, steps, [&](HaloBand<std::uint8_t>& copy) {
        grow_copy(copy, within, steps);
        copy.write_band(mask);
    });
    return mask;
}

void fill_small_holes(Mask& mask, std::int64_t fewer_than, Executor& threads) {
    const Regions holes = connected_regions(mask, 0, 0, threads);
    const std::vector<CellBox> boxes = bounding_boxes(holes);
    const auto is_small = [&](Label label) {
        const CellBox& box = boxes[label];
        return holes.cells[label] < fewer_than && box.first_row > 0 && box.end_row < mask.rows &&
               box.first_col > 0 && box.end_col < mask.cols;
    };
    paint(holes, is_small, 1, mask, threads);
}

Mask grow_by_majority(Mask seeds, const Mask& elevated, const CellSize& cell, Executor& threads) {
    for (int i = 0; i < growth_rounds; ++i)
        seeds = majority_filter(seeds, elevated, elevated, growth_reach_m, cell, growth_shares, threads);
    return seeds;
}

Mask smooth_border(const Mask& mask, const Mask& within, const CellSize& cell, Executor& threads) {
    const Mask all(mask.rows, mask.cols, 1, threads);
    return majority_filter(mask, all, within, border_reach_m, cell, border_shares, threads);
}

}  // namespace d2b
