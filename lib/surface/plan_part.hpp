#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "surface/plan.hpp"

namespace d2b {

/// Extracts the plan of some contours as if the others did not exist: they become outside, and nodes between
/// collinear edges are removed. O(n log n) in the given edges. @param edges of the plan, all that bound these
/// contours @param belongs true if a contour is one of them
[[nodiscard]] Plan plan_part(const Plan& plan, std::span<const std::uint32_t> edges,
                             const std::function<bool(std::int32_t)>& belongs);

}  // namespace d2b
