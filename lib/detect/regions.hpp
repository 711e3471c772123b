#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "detect/label_sets.hpp"
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

/// Makes regions of links, row by row: what hangs together is joined by union-find on runs. Time O(cells) but
/// for the inverse of Ackermann's function. Carry: the runs.
class RegionBuilder {
  public:
    explicit RegionBuilder(std::int32_t cols);
    /// @param links the next row's
    void add_row(std::span<const std::uint8_t> links);
    [[nodiscard]] Regions finish() &&;

  private:
    /// Joins the run at `c` with the run above it. @returns the column behind that
    std::int32_t join_above(std::int32_t c, std::size_t& above, Label& label);

    Regions regions_;
    LabelSets sets_;
};

/// Links of a row of cells that are joined where they share an edge. @param value 0 or 1: the cells that
/// belong to regions
void edge_links(const Mask& mask, std::int32_t r, std::uint8_t value, std::vector<std::uint8_t>& links);

/// Regions of cells that are joined to their left or upper neighbours.
/// @param in cells that belong to a region
/// @param joined joined(i, j): whether the neighbours at the indices i and j, both in, belong together
template <typename Joined>
[[nodiscard]] Regions joined_regions(const Mask& in, Joined joined) {
    RegionBuilder builder(in.cols);
    std::vector<std::uint8_t> links;
    for (std::int32_t r = 0; r < in.rows; ++r) {
        edge_links(in, r, 1, links);
        for (std::size_t c = 0; c < links.size(); ++c) {
            const std::size_t i = in.index(r, static_cast<std::int32_t>(c));
            if ((links[c] & link_left) != 0 && !joined(i - 1, i))
                links[c] ^= link_left;
            if ((links[c] & link_up) != 0 && !joined(i - links.size(), i))
                links[c] ^= link_up;
        }
        builder.add_row(links);
    }
    return std::move(builder).finish();
}

/// Regions of cells of a value, 0 or 1, that share edges.
[[nodiscard]] Regions connected_regions(const Mask& mask, std::uint8_t value = 1);

/// Takes the regions out that have fewer cells; the others are numbered anew in the same order.
void drop_small(Regions& regions, std::int64_t least_cells);

[[nodiscard]] Mask mask_of(const Regions& regions);

/// @param number what to write for each label; one entry a label, [0] for none
[[nodiscard]] Grid<Label> label_grid(const Regions& regions, std::span<const Label> number);

}  // namespace d2b
