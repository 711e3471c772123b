#pragma once

#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "flow/flow_limits.hpp"
#include "flow/flow_problem.hpp"
#include "surface/planar_partition.hpp"

namespace d2b {

struct FlowReady {
    std::vector<FinePolygon> outlines;  ///< of all contours; none where nothing has changed
    std::vector<FlowProblem> problems;
};

/// Changes the outlines of contours that may come near each other until a flow solver can take them: walls
/// that are too short are merged, gaps that are too narrow closed, corners that are too sharp or touch taken
/// off. Works on the planar partition, whose nodes are moved onto others and whose edges are split, exactly;
/// changes that would come to more than a share of a block are not made. What is left has an entry. Outlines
/// nest as they did, share what they shared, and are valid; where that cannot be had all stays as it
/// was, and so where nothing is won and nothing has touched. Corners in straight walls go in any case.
/// @param contours parents before what stands on them
/// @param frozen those whose walls stay where they are, but for corners that touch; empty for none
/// @throws Cancelled
[[nodiscard]] FlowReady make_flow_ready(std::span<const PartitionContour> contours, const FlowLimits& limits,
                                        const std::vector<bool>& frozen = {}, const StopToken& stop = {});

}  // namespace d2b
