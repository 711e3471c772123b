#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Planar partition, or the contours that prevent one.
struct PartitionResult {
    PlanarPartition plan;
    /// Contours that cross others, overlap them without being their children, or extend beyond their parents;
    /// of a conflicting pair, the later one. If there are any, the plan is unusable.
    std::vector<std::uint32_t> conflicting;
};

/// Computes the planar partition by the topmost contour. Edges are split at vertices of other outlines, so
/// that edges meet only at nodes. Exact, on integers. O(n log n) in the number of vertices, unless many boxes
/// overlap. @param contours parents before children @throws Cancelled
[[nodiscard]] PartitionResult make_partition(std::span<const PartitionContour> contours,
                                             const StopToken& stop = {});

/// Returns the outlines with a vertex wherever a vertex of another outline lies on an edge.
[[nodiscard]] std::vector<FinePolygon> noded_outlines(std::span<const PartitionContour> contours);

}  // namespace d2b::surface
