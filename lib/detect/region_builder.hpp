#pragma once

#include <span>
#include <vector>

#include "detect/label_sets.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Makes regions of links, row by row. Carried state: the runs.
class RegionBuilder {
  public:
    explicit RegionBuilder(std::int32_t cols);
    /// @param links the next row's; the first has none to the row above
    void add_row(std::span<const std::uint8_t> links);
    /// @param runs of the next row's cells, which hang together where they share an edge; their labels do not
    /// matter
    void add_touching_row(std::span<const RegionRun> runs);
    /// @param least_cells regions with fewer cells are left out, if they reach neither the first row nor the
    /// last
    [[nodiscard]] Regions finish(std::int64_t least_cells) &&;

  private:
    /// Joins the run at `c` with the run above it. @returns the column behind that
    std::int32_t join_above(std::int32_t c, std::size_t& above, Label& label);

    Regions regions_;
    LabelSets sets_;
};

/// Gives runs other labels, and takes those out that get 0. The numbers of cells are as they were.
void relabel(Regions& regions, std::span<const Label> number);

}  // namespace d2b
