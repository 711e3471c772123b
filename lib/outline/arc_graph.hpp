#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contours/contour.hpp"
#include "core/lattice.hpp"
#include "core/stop_token.hpp"

namespace d2b::outline {

/// Index of the corners of all outlines by row and by column. Compression may leave a corner of one outline
/// in the middle of an edge of another on a shared wall. Noding inserts it into both, because otherwise
/// rounding, reprojection or simplification could separate the shared edge.
class CornerIndex {
  public:
    explicit CornerIndex(const std::vector<contours::Contour>& contours);
    explicit CornerIndex(std::span<const contours::Contour* const> contours);

    /// @param ring corners of a rectilinear ring @return the ring with all corners of other outlines on it
    [[nodiscard]] LatticeRing noded(const LatticeRing& ring) const;
    [[nodiscard]] LatticePolygon noded(const LatticePolygon& polygon) const;

  private:
    void add(const contours::Contour& contour);
    void sort();
    void append_between(LatticePoint from, LatticePoint to, LatticeRing& ring) const;

    std::vector<LatticePoint> by_row_;  ///< distinct, sorted by row, then column
    std::vector<LatticePoint> by_col_;  ///< same with row and column swapped
};

/// Traced outline of a contour.
[[nodiscard]] LatticePolygon traced_polygon(const contours::Contour& contour);

/// A path of an outline between two junctions, or a ring without junctions (its first point is then repeated
/// at the end). Neighbours and levels share the arc object, so an edit applies to all of them.
using Arc = std::vector<LatticePoint>;

/// Oriented use of an arc by a ring.
struct ArcUse {
    std::uint32_t arc = 0;
    bool reversed = false;
};

/// Outlines of all contours as one planar graph.
struct ArcGraph {
    struct Outline {
        std::vector<ArcUse> exterior;
        std::vector<std::vector<ArcUse>> interiors;
    };
    std::vector<Arc> arcs;
    std::vector<Outline> outlines;  ///< one per contour

    /// Assembles the outline of a contour from the current arcs.
    [[nodiscard]] LatticePolygon polygon(std::size_t contour) const;
};

/// Nodes the outlines and splits them into arcs at junctions, i.e. points with a degree other than two. O(n
/// log n) in the number of vertices. @throws Cancelled
[[nodiscard]] ArcGraph build_arc_graph(std::span<const contours::Contour* const> contours,
                                       const StopToken& stop = {});
[[nodiscard]] ArcGraph build_arc_graph(const std::vector<contours::Contour>& contours,
                                       const StopToken& stop = {});

}  // namespace d2b::outline
