#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "surface/plan.hpp"

namespace d2b {

/// What a plan shows of some contours, as if nothing stood beside them: all else is outside, nodes at which
/// they run on straight are gone. O(n log n) in the edges that are given.
/// @param edges of the plan, all that border on these contours @param belongs whether a contour is one of
/// them
[[nodiscard]] Plan plan_part(const Plan& plan, std::span<const std::uint32_t> edges,
                             const std::function<bool(std::int32_t)>& belongs);

}  // namespace d2b
