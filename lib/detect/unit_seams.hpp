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

/// What a unit saw of the cells beside its seams, as far as they lie beside its own.
struct UnitEdges {
    /// The cells on both sides of a seam, the upper or left ones first; empty at the border of the window.
    using Lines = std::array<std::vector<Label>, 2>;

    Lines above;
    Lines left;
    Lines below;
    Lines right;

    /// Adds to all labels other than 0.
    void add(Label more);
};
/// @param labels of what the unit sees
[[nodiscard]] UnitEdges edges_of(const Unit& unit, const Grid<Label>& labels);

/// Compares what units saw of the seams between them. Units come row by row, and what one saw is kept until
/// the unit on the other side has come.
class UnitSeams {
  public:
    /// @param unit_cols units in a row
    explicit UnitSeams(std::int32_t unit_cols) : above_(static_cast<std::size_t>(unit_cols)) {}

    /// @param edges of the next unit, with labels that have been added to @param col its place in its row
    void add(std::int32_t col, UnitEdges&& edges, UnitMerger& merger);

  private:
    std::vector<UnitEdges::Lines> above_;  ///< by place in the row: at the seam below the unit that came last
    UnitEdges::Lines left_;                ///< at the seam to the right of the unit before
};

}  // namespace d2b
