#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/band.hpp"
#include "core/grid.hpp"
#include "detect/merge_units.hpp"
#include "detect/unit_grid.hpp"

namespace d2b {

/// Labels that a unit assigned along its seams, next to its core.
struct UnitEdges {
    /// Cells on both sides of a seam, the upper or left ones first; empty at the border of the window.
    using Lines = std::array<std::vector<Label>, 2>;

    Lines above;
    Lines left;
    Lines below;
    Lines right;

    /// Adds an offset to all labels other than 0.
    void add(Label more);
};
/// @param labels labels of the unit's extent
[[nodiscard]] UnitEdges edges_of(const Unit& unit, const Grid<Label>& labels);

/// Compares the labels of adjacent units along their seams. Units come row by row, and the edges of one are
/// kept until the unit on the other side arrives.
class UnitSeams {
  public:
    /// @param unit_cols number of units in a row
    explicit UnitSeams(std::int32_t unit_cols) : above_(static_cast<std::size_t>(unit_cols)) {}

    /// @param edges edges of the next unit, with labels that include its offset
    /// @param col column of the unit
    void add(std::int32_t col, UnitEdges&& edges, UnitMerger& merger);

  private:
    std::vector<UnitEdges::Lines>
        above_;              ///< by column: edges at the seam below the latest unit of that column
    UnitEdges::Lines left_;  ///< edges at the seam to the right of the previous unit
};

}  // namespace d2b
