#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/flow_faults.hpp"

namespace d2b::surface {

struct FlowReady {
    std::vector<FinePolygon> outlines;  ///< per contour; empty if nothing has changed
    std::vector<FlowProblem> problems;
};

/// Changes outlines until a flow solver can take them: merges walls that are too short, closes narrow gaps,
/// widens narrow parts, and cuts off corners that are too sharp or touch. Works on the planar partition,
/// whose nodes are moved onto others and whose edges are split, exactly. Changes that would take more than a
/// share of a block are not made; each fault that is left is a problem of the result. Outlines nest and share
/// walls as before and are valid; if that is impossible, or nothing is gained and nothing touched, all
/// outlines stay as they were, apart from corners in straight walls, which always go.
/// @param contours parents before their children
/// @param frozen contours whose walls stay, apart from corners that touch; empty for none
/// @throws Cancelled
[[nodiscard]] FlowReady make_flow_ready(std::span<const PartitionContour> contours, const FlowLimits& limits,
                                        const std::vector<bool>& frozen = {}, const StopToken& stop = {});

/// Removes corners at which a wall goes straight on within a millimetre, or within a step of the lattice if
/// that is longer. Corners of more than two walls stay. A wall moves by no more than that, however many
/// corners it loses.
/// @param may_go returns true if a node may be removed
void take_needless_corners(PartitionEditor& plan, const FlowMetric& metric,
                           const std::function<bool(std::uint32_t)>& may_go);

}  // namespace d2b::surface
