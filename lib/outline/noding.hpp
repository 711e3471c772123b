#pragma once

#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// The corners of all outlines, by rows and by columns. Compression leaves a corner of one outline in the
/// middle of an edge of another where they share a wall; noding puts it into both, so that what they share is
/// vertex for vertex the same, and rounding, reprojection or simplification cannot pull it apart.
class CornerIndex {
  public:
    explicit CornerIndex(const std::vector<Contour>& contours);
    explicit CornerIndex(std::span<const Contour* const> contours);

    /// @param ring corners of a rectilinear ring @return the ring with every corner of any outline that lies
    /// on it
    [[nodiscard]] LatticeRing noded(const LatticeRing& ring) const;
    [[nodiscard]] LatticePolygon noded(const LatticePolygon& polygon) const;

  private:
    void add(const Contour& contour);
    void sort();
    void append_between(LatticePoint from, LatticePoint to, LatticeRing& ring) const;

    std::vector<LatticePoint> by_row_;  ///< distinct, sorted by row, then column
    std::vector<LatticePoint> by_col_;  ///< the same turned over: row and column swapped
};

/// A contour's outline as it was traced.
[[nodiscard]] LatticePolygon traced_polygon(const Contour& contour);

}  // namespace d2b
