#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Outlines of a partition.
struct PlanOutlines {
    std::vector<FinePolygon> outlines;  ///< one per contour, if none is broken
    std::vector<std::uint32_t> broken;  ///< contours that are in pieces, or gone
};

/// Draws the outline of each contour from the partition: a contour covers its own faces and those of all
/// contours on top of it. @throws Cancelled
[[nodiscard]] PlanOutlines plan_outlines(const PlanarPartition& plan,
                                         std::span<const PartitionContour> contours,
                                         const StopToken& stop = {});

}  // namespace d2b::surface
