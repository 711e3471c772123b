#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "core/stop_request.hpp"
#include "surface/node_star.hpp"
#include "surface/plan.hpp"
#include "surface/plan_gaps.hpp"

namespace d2b {

/// Distances by which touching corners are moved apart.
struct PinchReach {
    using Contours = std::span<const std::int32_t>;
    std::int64_t steps = 0;  ///< wanted distance, if more than the minimum gap
    PlanGaps gaps = {};      ///< minimum distance of a move
    /// Returns true if a move may change this area of the contours around it, in square steps: next to open
    /// ground, and between contours. Empty: always. Not called for minimal moves.
    std::function<bool(Contours contours, double outside, double inside)> allows = {};
    /// Called for every move, including minimal ones.
    std::function<void(Contours contours, double outside)> take = {};
};

/// Area swept by moving edges, in square steps.
struct PassedOver {
    double outside = 0;  ///< by edges next to open ground
    double inside = 0;   ///< by edges between contours

    /// Adds an edge with one moving end. @param beside the contours on both sides of the edge
    void add(const NodeArm& beside, FinePoint end, FinePoint from, FinePoint to);
};

/// Returns the distinct contours around a node.
[[nodiscard]] std::vector<std::int32_t> contours_of(const std::vector<NodeArm>& arms);

/// Returns the angle counter-clockwise from east, y up.
[[nodiscard]] double angle_of(FinePoint from, FinePoint to);
/// Returns the angle from a to b, in (0, 2 pi], counter-clockwise.
[[nodiscard]] double turned_from(double a, double b);

/// Returns decreasing distances to try, from `wanted` on; all exceed the minimum gap.
[[nodiscard]] std::vector<std::int64_t> reaches_down_from(std::int64_t wanted, const LatticeGap& pinch);

/// Planned distance by position of the vertex; 0 if only a minimal move is allowed.
using PlannedReaches = std::map<FinePoint, std::int64_t>;

/// Chooses distances for the corners of a plan. Splits long edges near corners that will move, so that only
/// the corner is cut off, instead of a whole wall moving.
[[nodiscard]] PlannedReaches plan_reaches(Plan& plan, std::span<const PlanContour> contours,
                                          const PinchReach& wanted, const StopRequest& stop);

}  // namespace d2b
