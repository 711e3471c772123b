#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/stop_request.hpp"
#include "surface/pinch_reach.hpp"
#include "surface/plan.hpp"

namespace d2b {

/// What was done at a node.
struct PinchMend {
    FinePoint place;
    FinePoint moved;      ///< where the corner that moved is now
    bool filled = false;  ///< a notch within a building, else buildings were cut back from each other
    std::vector<std::int32_t> contours;  ///< around it
};

struct PinchesTaken {
    std::vector<PinchMend> mends;
    std::vector<std::uint32_t> stuck;  ///< contours at nodes where there is no room; ascending
};

/// Changes a plan until no vertical line has more than two walls, neither of all buildings together nor of
/// one alone, and no face touches itself: where one does, a run of sectors is moved off the node by the gap
/// of a pinch, or by as little more as its angle needs, and an edge joins it to the node. Where more is
/// wanted it is moved by that, or by as little less as there is room for and as is allowed; where there is no
/// room for the gap, by less than that.
///
///                   A and C stand out,                      or, where A and C are of
///      A | B        B and D are low:           A | B        one building, a corner      A \ B
///     ---+---       a corner of C            ---+           of B moves, and so fills   ---+ +---
///      D | C        moves                      D \ +---      the notch between them      D | C
///                                                 | C
///
/// Corners of nothing else are passed over, so that the plan stays planar, exactly; and it is not moved near
/// others, where there is room elsewhere.
/// @throws Cancelled
[[nodiscard]] PinchesTaken take_apart_pinches(Plan& plan, std::span<const PlanContour> contours,
                                              const PinchReach& wanted = {}, const StopRequest& stop = {});

}  // namespace d2b
