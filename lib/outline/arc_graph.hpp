#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "trace/contour.hpp"

namespace d2b {

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
[[nodiscard]] ArcGraph build_arc_graph(std::span<const Contour* const> contours,
                                       const StopRequest& stop = {});
[[nodiscard]] ArcGraph build_arc_graph(const std::vector<Contour>& contours, const StopRequest& stop = {});

}  // namespace d2b
