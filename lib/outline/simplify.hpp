#pragma once

#include <vector>

#include "core/georeference.hpp"
#include "outline/arc_graph.hpp"

namespace d2b {

/// Straightens the arcs of a planar graph, so that outlines that share them stay nested, disjoint and valid.
///
/// One vertex after the other goes, the one that moves the outline least first, if
///  - every point of the original arc that the new edge replaces lies within the tolerance of it, and so
///  every
///    point of the edge within the tolerance of the arc: both Hausdorff distances are bounded; and
///  - no other vertex of the graph lies in the triangle that the outline sweeps over, its border included,
///  and the
///    new edge is not there yet. Then nothing is crossed, and nothing changes sides.
/// The second test is exact, on integers. Junctions and the first point of a closed arc stay. What remains
/// has no point that was not in the trace.
/// @param tolerance in units of the CRS, more than 0 @throws Cancelled
void simplify(std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
              const StopRequest& stop = {});

}  // namespace d2b
