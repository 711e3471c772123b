#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/row_bands.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Cells of one row, from `begin` to before `end`, that belong to one region.
struct RegionRun {
    std::int32_t begin = 0;
    std::int32_t end = 0;
    Label label = 0;
};

/// Regions, numbered from 1 in the scan order of their first cells. They are kept as runs, in scan order:
/// that takes little memory, and a look at a region's cells looks at nothing else.
struct Regions {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::vector<RegionRun> runs;
    std::vector<std::size_t> row_begin;  ///< index of each row's first run, and the number of runs
    std::vector<std::int64_t> cells;     ///< of each region, by label; [0] is not used

    [[nodiscard]] Label count() const { return static_cast<Label>(cells.size() - 1); }
    [[nodiscard]] std::span<const RegionRun> row(std::int32_t r) const {
        const auto i = static_cast<std::size_t>(r);
        return {runs.data() + row_begin[i], row_begin[i + 1] - row_begin[i]};
    }
};

/// How a cell hangs together with those before it, as bits of a byte.
enum Link : std::uint8_t {
    link_in = 1,    ///< it belongs to a region; without this bit the others are not set
    link_left = 2,  ///< to its left neighbour's
    link_up = 4     ///< to its upper neighbour's
};

/// Gives the links of a row, one a cell; called on any thread.
using LinksOfRow = std::function<void(std::int32_t row, std::vector<std::uint8_t>& links)>;

/// Makes regions of links: bands of rows on all threads, where what hangs together is joined by union-find on
/// runs, and bands with each other. Time O(cells) but for the inverse of Ackermann's function.
/// @param least_cells regions with fewer cells are left out
[[nodiscard]] Regions linked_regions(std::int32_t rows, std::int32_t cols, const LinksOfRow& links_of,
                                     std::int64_t least_cells, Executor& threads);

/// Links of a row of cells that are joined where they share an edge. @param value 0 or 1: the cells that
/// belong to regions
void edge_links(const Mask& mask, std::int32_t r, std::uint8_t value, std::vector<std::uint8_t>& links);

/// Regions of cells that are joined to their left or upper neighbours.
/// @param in cells that belong to a region
/// @param joined joined(i, j): whether the neighbours at the indices i and j, both in, belong together
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

/// Regions of cells of a value, 0 or 1, that share edges. @param least_cells as for linked_regions
[[nodiscard]] Regions connected_regions(const Mask& mask, std::uint8_t value, std::int64_t least_cells,
                                        Executor& threads);

/// Labels from `first` to before `end`, and rows that hold all their cells.
struct LabelRange {
    Label first = 0;
    Label end = 0;
    RowBand rows;
};
/// Divides the labels into ranges with about as many cells each: not more than some, since what looks at
/// several passes over other labels' runs.
[[nodiscard]] std::vector<LabelRange> label_ranges(const Regions& regions);

/// Calls use(row, run) for all runs on all threads: those of one label on one thread and in scan order, so
/// that sums of a label do not depend on the number of threads.
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

/// @param number what to write for each label; one entry per label, [0] for none
[[nodiscard]] Grid<Label> label_grid(const Regions& regions, std::span<const Label> number,
                                     Executor& threads);

}  // namespace d2b
