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

/// What units saw of the cells beside the seams between them, kept until the unit on the other side has been
/// looked at. Units come row by row.
class UnitSeams {
  public:
    /// @param unit_cols units in a row
    explicit UnitSeams(std::int32_t unit_cols) : above_(static_cast<std::size_t>(unit_cols)) {}

    /// @param unit the next, @param col its place in its row @param labels of what it sees, added to
    void add(const Unit& unit, std::int32_t col, const Grid<Label>& labels, UnitMerger& merger);

  private:
    /// The cells on both sides of a seam that are beside a unit's own; empty at the border of the window.
    using Lines = std::array<std::vector<Label>, 2>;

    std::vector<Lines> above_;  ///< by place in the row: at the seam below the unit there that came last
    Lines left_;                ///< at the seam to the right of the unit before
};

}  // namespace d2b
