#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/grid.hpp"

namespace d2b {

/// Calls use(begin, end) for each run of cells with a value in a row of a mask.
/// @param value 0 or 1
template <typename Use>
void for_mask_runs(std::span<const std::uint8_t> row, std::uint8_t value, const Use& use) {
    const auto next = [&](std::size_t from, int wanted) {
        const void* const found =
            from < row.size() ? std::memchr(row.data() + from, wanted, row.size() - from) : nullptr;
        return found == nullptr
                   ? row.size()
                   : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - row.data());
    };
    for (std::size_t begin = next(0, value); begin < row.size();) {
        const std::size_t end = next(begin, value ^ 1);
        use(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
        begin = next(end, value);
    }
}

/// Run of cells [begin, end) of one row that belong to one region.
struct RegionRun {
    std::int32_t begin = 0;
    std::int32_t end = 0;
    Label label = 0;
};

/// Connected regions, numbered from 1 in the scan order of their first cells. They are stored as runs in scan
/// order, because that takes little memory and a pass over a region's cells reads nothing else.
struct Regions {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::vector<RegionRun> runs;
    std::vector<std::size_t> row_begin;  ///< index of each row's first run, then the number of runs
    std::vector<std::int64_t> cells;     ///< number of cells by label; [0] is unused

    [[nodiscard]] Label count() const { return static_cast<Label>(cells.size() - 1); }
    [[nodiscard]] std::span<const RegionRun> row(std::int32_t r) const {
        const auto i = static_cast<std::size_t>(r);
        return {runs.data() + row_begin[i], row_begin[i + 1] - row_begin[i]};
    }
};

/// Connections of a cell to its predecessors in scan order, as bits of a byte.
enum Link : std::uint8_t {
    link_in = 1,    ///< belongs to a region; if not set, the other bits are not set either
    link_left = 2,  ///< connected to its left neighbour
    link_up = 4     ///< connected to its upper neighbour
};

/// Computes the links of a row, one per cell. Called from any thread.
using LinksOfRow = std::function<void(std::int32_t row, std::vector<std::uint8_t>& links)>;

/// Connected-component labelling of links. Bands of rows are labelled in parallel by union-find on runs, then
/// joined across their seams. Time O(n α(n)) for n cells.
/// @param min_cells smaller regions are dropped
[[nodiscard]] Regions linked_regions(std::int32_t rows, std::int32_t cols, const LinksOfRow& links_of,
                                     std::int64_t min_cells, Executor& threads);

/// Computes the links of a row with 4-connectivity.
/// @param value 0 or 1: value of the cells that belong to regions
void edge_links(const Mask& mask, std::int32_t r, std::uint8_t value, std::vector<std::uint8_t>& links);

/// Labels regions of cells connected to their left or upper neighbours.
/// @param in cells that belong to a region
/// @param joined joined(i, j): true if the neighbouring cells at indices i and j, both in regions, are
/// connected
template <typename Joined>
[[nodiscard]] Regions joined_regions(const Mask& in, Joined joined, Executor& threads) {
    const auto links_of = [&](std::int32_t r, std::vector<std::uint8_t>& links) {
        edge_links(in, r, 1, links);
        for (std::size_t c = 0; c < links.size(); ++c) {
            const std::size_t i = in.index(r, static_cast<std::int32_t>(c));
            if ((links[c] & link_left) != 0 && !joined(i - 1, i))
                links[c] ^= link_left;
            if ((links[c] & link_up) != 0 && !joined(i - links.size(), i))
                links[c] ^= link_up;
        }
    };
    return linked_regions(in.rows, in.cols, links_of, 0, threads);
}

/// Labels the 4-connected regions of cells with value 0 or 1.
/// @param min_cells see linked_regions()
[[nodiscard]] Regions connected_regions(const Mask& mask, std::uint8_t value, std::int64_t min_cells,
                                        Executor& threads);

/// Labels [first, end) and the rows that contain all their cells.
struct LabelRange {
    Label first = 0;
    Label end = 0;
    RowBand rows;
};
/// Divides the labels into ranges with similar numbers of cells. Their number is limited, because a thread
/// that processes several ranges also scans the runs of other labels.
[[nodiscard]] std::vector<LabelRange> label_ranges(const Regions& regions);

/// Calls use(row, run) for all runs in parallel. Runs of one label are visited by one thread in scan order,
/// so that floating-point sums per label do not depend on the number of threads.
template <typename Use>
void for_runs_by_label(Executor& threads, const Regions& regions, const Use& use) {
    const std::vector<LabelRange> ranges = label_ranges(regions);
    threads.for_each(ranges.size(), [&](std::size_t i) {
        for (std::int32_t r = ranges[i].rows.begin; r < ranges[i].rows.end; ++r)
            for (const RegionRun& run : regions.row(r))
                if (run.label >= ranges[i].first && run.label < ranges[i].end)
                    use(r, run);
    });
}

/// Calls use(row, run) for all runs, in scan order.
template <typename Use>
void for_runs(const Regions& regions, const Use& use) {
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            use(r, run);
}

/// Calls use(row, run) for the first run of each region, in the order of the labels.
template <typename Use>
void for_first_runs(const Regions& regions, const Use& use) {
    Label seen = 0;
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        if (run.label <= seen)
            return;
        seen = run.label;
        use(r, run);
    });
}

/// Returns the run of a row that contains a column, or null.
[[nodiscard]] const RegionRun* run_at(std::span<const RegionRun> row, std::int32_t col);

/// Writes a value into the cells of the regions with a property.
/// @param has has(label): true if the region has it
template <typename Has>
void paint(const Regions& regions, const Has& has, std::uint8_t value, Mask& mask, Executor& threads) {
    for_rows(threads, regions.rows, regions.cols, [&](std::int32_t r) {
        for (const RegionRun& run : regions.row(r))
            if (has(run.label))
                std::fill_n(mask.row(r).data() + run.begin, run.end - run.begin, value);
    });
}

/// Returns the cells of all regions, or of those with a property.
template <typename Has>
[[nodiscard]] Mask mask_of(const Regions& regions, const Has& has, Executor& threads) {
    Mask result(regions.rows, regions.cols, 0, threads);
    paint(regions, has, 1, result, threads);
    return result;
}
[[nodiscard]] inline Mask mask_of(const Regions& regions, Executor& threads) {
    return mask_of(
        regions, [](Label) { return true; }, threads);
}

/// Smallest rectangle of cells that contains a region.
struct CellBox {
    std::int32_t first_row = std::numeric_limits<std::int32_t>::max();
    std::int32_t end_row = 0;
    std::int32_t first_col = std::numeric_limits<std::int32_t>::max();
    std::int32_t end_col = 0;

    [[nodiscard]] std::int32_t rows() const { return end_row - first_row; }
    [[nodiscard]] std::int32_t cols() const { return end_col - first_col; }
};
/// Returns the boxes of all regions by label; [0] is unused.
[[nodiscard]] std::vector<CellBox> bounding_boxes(const Regions& regions);

/// Paints regions into a grid.
/// @param number value written per label; [0] is used for cells outside of regions
[[nodiscard]] Grid<Label> label_grid(const Regions& regions, std::span<const Label> number,
                                     Executor& threads);

/// Relabels runs and removes those that get 0. Regions::cells is not changed.
void relabel(Regions& regions, std::span<const Label> number);

/// Drops the regions without a property and numbers the others from 1.
/// @param has has(label): true if the region has it
template <typename Has>
void keep_regions(Regions& regions, const Has& has) {
    std::vector<Label> number(regions.cells.size(), 0);
    std::vector<std::int64_t> left(1, 0);
    for (Label label = 1; label < number.size(); ++label)
        if (has(label)) {
            number[label] = static_cast<Label>(left.size());
            left.push_back(regions.cells[label]);
        }
    relabel(regions, number);
    regions.cells = std::move(left);
}

/// Number of cells shared by a region of one set and a region of another set.
struct RegionOverlap {
    Label one = 0;
    Label other = 0;
    std::int64_t cells = 0;

    friend bool operator==(const RegionOverlap&, const RegionOverlap&) = default;
};

/// Returns all overlaps between two sets of regions on the same grid, sorted by the labels of the first set,
/// then the second.
[[nodiscard]] std::vector<RegionOverlap> region_overlaps(const Regions& one, const Regions& other);

/// Returns the label of `other` with most cells in each region of `one`; the lowest label in case of a tie, 0
/// if there is no overlap. [0] is 0.
[[nodiscard]] std::vector<Label> containing_regions(const Regions& one, const Regions& other);

}  // namespace d2b
