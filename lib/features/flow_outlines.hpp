#pragma once

#include <cstdint>
#include <vector>

#include "core/context.hpp"
#include "features/problem_layer.hpp"
#include "features/write_features.hpp"
#include "flow/make_flow_ready.hpp"
#include "outline/outline.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// Makes the outlines of what stands on the ground ready for a flow solver, cluster by cluster on all
/// threads, and has the outliner draw what has changed. What was done and what was left is counted in the
/// report.
/// @return the faults; their contours are places in the list @throws Cancelled
[[nodiscard]] std::vector<FlowProblem> make_outlines_flow_ready(const ContourList& contours,
                                                                Outliner& outliner, const FlowLimits& limits,
                                                                Context& context);

/// Steps of the fine lattice on the ground. @param x_stretch as Outliner's
/// @param cell_size_m side of a square of a cell's area
[[nodiscard]] FlowMetric flow_metric(const Georeference& georeference, double x_stretch, double cell_size_m);

/// The same for the layer of problems. @param first_id of the sink
[[nodiscard]] std::vector<PlacedProblem> placed_problems(const std::vector<FlowProblem>& problems,
                                                         const FeatureInput& input, std::int64_t first_id);

}  // namespace d2b
