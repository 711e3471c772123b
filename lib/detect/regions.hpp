#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/row_bands.hpp"
#include "detect/scene.hpp"

namespace d2b {

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
/// @param least_cells smaller regions are dropped
[[nodiscard]] Regions linked_regions(std::int32_t rows, std::int32_t cols, const LinksOfRow& links_of,
                                     std::int64_t least_cells, Executor& threads);

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
/// @param least_cells see linked_regions()
[[nodiscard]] Regions connected_regions(const Mask& mask, std::uint8_t value, std::int64_t least_cells,
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

[[nodiscard]] Mask mask_of(const Regions& regions, Executor& threads);

/// Paints regions into a grid.
/// @param number value written per label; [0] is used for cells outside of regions
[[nodiscard]] Grid<Label> label_grid(const Regions& regions, std::span<const Label> number,
                                     Executor& threads);

}  // namespace d2b
