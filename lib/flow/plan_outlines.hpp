#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/planar_partition.hpp"

namespace d2b {

/// What a plan shows.
struct PlanOutlines {
    std::vector<FinePolygon> outlines;  ///< one a contour, where none is broken
    std::vector<std::uint32_t> broken;  ///< contours that are in pieces, or gone
};

/// The outline of each contour, from the plan that shows which of them is on top where: what a contour covers
/// is what it shows and all that stands on it.
[[nodiscard]] PlanOutlines plan_outlines(const PlanarPartition& plan,
                                         std::span<const PartitionContour> contours);

}  // namespace d2b
