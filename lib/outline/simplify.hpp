#pragma once

#include <vector>

#include "core/georeference.hpp"
#include "outline/arc_graph.hpp"

namespace d2b::outline {

/// Simplifies the arcs of a planar graph, keeping all outlines that share them nested, disjoint and valid.
///
/// Removes vertices one by one, beginning with the one that changes the outline least, if
///  - every point of the original arc that the new edge replaces is within the tolerance of that edge, and
///    vice versa, so both Hausdorff distances are bounded; and
///  - no other vertex of the graph lies in the swept triangle, border included, and the new edge does not
///    exist yet. This prevents intersections and changes of side.
/// The second test is exact, with integers. Junctions and the first point of a closed arc are kept, and no
/// new points are created.
/// @param tolerance in units of the CRS, positive @throws Cancelled
void simplify(std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
              const StopToken& stop = {});

}  // namespace d2b::outline
