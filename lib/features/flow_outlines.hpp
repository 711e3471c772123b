#pragma once

#include <cstdint>
#include <vector>

#include "contours/contour.hpp"
#include "core/context.hpp"
#include "features/problem_layer.hpp"
#include "features/write_features.hpp"
#include "outline/outline.hpp"
#include "surface/make_flow_ready.hpp"

namespace d2b::features {

/// Makes outlines above the ground flow-ready, clusters in parallel, and replaces the changed ones in the
/// outliner. Counts repaired and remaining defects in the report.
/// @return the defects; their contours are indices in the list @throws Cancelled
[[nodiscard]] std::vector<surface::FlowProblem> make_outlines_flow_ready(
    const contours::ContourList& contours, outline::Outliner& outliner, const surface::FlowLimits& limits,
    Context& context);

/// Returns the steps of the fine lattice in metres. @param x_stretch see Outliner
/// @param cell_size_m side of a square with the area of a cell
[[nodiscard]] surface::FlowMetric flow_metric(const Georeference& georeference, double x_stretch,
                                              double cell_size_m);

/// Converts defects to records of the problems layer. @param first_id of the sink
[[nodiscard]] std::vector<PlacedProblem> placed_problems(const std::vector<surface::FlowProblem>& problems,
                                                         const FeatureInput& input, std::int64_t first_id);

}  // namespace d2b::features
