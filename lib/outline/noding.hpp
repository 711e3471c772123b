#pragma once

#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// Index of the corners of all outlines by row and by column. Compression may leave a corner of one outline
/// in the middle of an edge of another on a shared wall. Noding inserts it into both, because otherwise
/// rounding, reprojection or simplification could separate the shared edge.
class CornerIndex {
  public:
    explicit CornerIndex(const std::vector<Contour>& contours);
    explicit CornerIndex(std::span<const Contour* const> contours);

    /// @param ring corners of a rectilinear ring @return the ring with all corners of other outlines on it
    [[nodiscard]] LatticeRing noded(const LatticeRing& ring) const;
    [[nodiscard]] LatticePolygon noded(const LatticePolygon& polygon) const;

  private:
    void add(const Contour& contour);
    void sort();
    void append_between(LatticePoint from, LatticePoint to, LatticeRing& ring) const;

    std::vector<LatticePoint> by_row_;  ///< distinct, sorted by row, then column
    std::vector<LatticePoint> by_col_;  ///< same with row and column swapped
};

/// Traced outline of a contour.
[[nodiscard]] LatticePolygon traced_polygon(const Contour& contour);

}  // namespace d2b
