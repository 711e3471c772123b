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

/// How far corners that touch are to be moved.
struct PinchReach {
    using Contours = std::span<const std::int32_t>;
    std::int64_t steps = 0;  ///< where more is wanted than the gap of a pinch
    PlanGaps gaps = {};      ///< that corners are moved by at least
    /// Whether a move may take so much of the contours around it, in square steps: beside open ground, and
    /// between them. Nothing: always. What is usual is not asked for.
    std::function<bool(Contours contours, double outside, double inside)> allows = {};
    /// Told of every move that is made, also of what is usual.
    std::function<void(Contours contours, double outside)> take = {};
};

/// What edges pass over, in square steps.
struct PassedOver {
    double outside = 0;  ///< those beside open ground
    double inside = 0;   ///< those between contours

    /// An edge whose one end moves. @param beside the edge
    void add(const NodeArm& beside, FinePoint end, FinePoint from, FinePoint to);
};

/// The contours around a node, each once.
[[nodiscard]] std::vector<std::int32_t> contours_of(const std::vector<NodeArm>& arms);

/// Counter-clockwise from east, y up.
[[nodiscard]] double angle_of(FinePoint from, FinePoint to);
/// From 0 to a full turn, counter-clockwise.
[[nodiscard]] double turned_from(double a, double b);

/// The reach that is wanted, and from it on as little less as a move may take; all above the gap of a pinch.
[[nodiscard]] std::vector<std::int64_t> reaches_down_from(std::int64_t wanted, const LatticeGap& pinch);

/// The reach of each pinch by its place; 0 where it may be moved no farther than is usual.
using PlannedReaches = std::map<FinePoint, std::int64_t>;

/// Chooses how far the corners of a plan are to move. Long edges of those that move get a node nearby, so
/// that a corner is cut off, and not the whole of a wall moves.
[[nodiscard]] PlannedReaches plan_reaches(Plan& plan, std::span<const PlanContour> contours,
                                          const PinchReach& wanted, const StopRequest& stop);

}  // namespace d2b
