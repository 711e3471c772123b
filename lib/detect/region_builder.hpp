#pragma once

#include <span>
#include <vector>

#include "detect/label_sets.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Builds regions from links, row by row. State: the runs so far.
class RegionBuilder {
  public:
    explicit RegionBuilder(std::int32_t cols);
    /// @param links links of the next row; the first row has none upwards
    void add_row(std::span<const std::uint8_t> links);
    /// @param runs runs of the next row, connected by shared edges; their labels are ignored
    void add_touching_row(std::span<const RegionRun> runs);
    /// @param least_cells smaller regions are dropped unless they touch the first or last row
    [[nodiscard]] Regions finish(std::int64_t least_cells) &&;

  private:
    /// Joins the run at `c` with the run above it.
    /// @returns the end column of the latter
    std::int32_t join_above(std::int32_t c, std::size_t& above, Label& label);

    Regions regions_;
    LabelSets sets_;
};

/// Relabels runs and removes those that get 0. Regions::cells is not changed.
void relabel(Regions& regions, std::span<const Label> number);

}  // namespace d2b
