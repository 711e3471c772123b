#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flow/flow_limits.hpp"
#include "surface/plan_editor.hpp"

namespace d2b {

enum class FlowKind {
    wall,   ///< an edge that is too short
    angle,  ///< between two edges that follow each other around a node
    gap     ///< between a node and an edge with a lower place between them
};

/// What a flow solver cannot take.
struct FlowFault {
    FlowKind kind = FlowKind::wall;
    std::uint32_t node = 0;
    std::uint32_t one = 0;    ///< wall: its other end, or what lies on the way to it; angle: end of the first
                              ///< edge; gap: the edge
    std::uint32_t other = 0;  ///< angle: end of the second edge
    double size = 0;          ///< m, or degrees
    FinePoint place;          ///< gap: of the edge, nearest to the node
};

/// All that falls short of the limits, in the order of edges and nodes. Edges that run on straight at a node
/// that has no third one are one wall. Where a gap ends in a wedge its angle counts, and not its width.
[[nodiscard]] std::vector<FlowFault> find_faults(const PlanEditor& plan,
                                                 std::span<const PlanContour> contours,
                                                 const FlowLimits& limits);

}  // namespace d2b
