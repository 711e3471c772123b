#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// A stretch of outline between two junctions, or a whole ring without one (then its first point is repeated
/// at the end). Neighbours and levels that share it share this object: whoever moves it moves it for all.
using Arc = std::vector<LatticePoint>;

/// An arc in a ring, along or against its direction.
struct ArcUse {
    std::uint32_t arc = 0;
    bool reversed = false;
};

/// The outlines of all contours as one planar graph.
struct ArcGraph {
    struct Outline {
        std::vector<ArcUse> exterior;
        std::vector<std::vector<ArcUse>> interiors;
    };
    std::vector<Arc> arcs;
    std::vector<Outline> outlines;  ///< one a contour

    /// A contour's outline from the arcs as they are now.
    [[nodiscard]] LatticePolygon polygon(std::size_t contour) const;
};

/// Nodes the outlines and cuts them into arcs at junctions: points where other than two edges meet.
/// O(n log n) in vertices. @throws Cancelled
[[nodiscard]] ArcGraph build_arc_graph(std::span<const Contour* const> contours,
                                       const StopRequest& stop = {});
[[nodiscard]] ArcGraph build_arc_graph(const std::vector<Contour>& contours, const StopRequest& stop = {});

}  // namespace d2b
