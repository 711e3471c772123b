#pragma once

#include <span>
#include <vector>

#include "flow/flow_limits.hpp"
#include "surface/plan.hpp"

namespace d2b {

/// Of the block that each contour belongs to, m2: touching contours of the lowest level are one.
/// @param edges of the partition of these contours
[[nodiscard]] std::vector<double> block_areas(std::span<const PlanContour> contours,
                                              std::span<const PlanEdge> edges, const FlowMetric& metric);

}  // namespace d2b
