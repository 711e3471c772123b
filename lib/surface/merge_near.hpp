#pragma once

#include <cstdint>
#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_gaps.hpp"

namespace d2b {

/// Makes nodes one that are not a gap apart, where nothing lies in the way, because programs that read
/// solids do so and break what runs between them. The plan stays planar, exactly.
void merge_near_nodes(Plan& plan, const LatticeGap& gap);

/// Brings roofs that meet in a node and are fewer steps of height apart than a gap to the higher one of them,
/// because a wall of that height has corners that are taken for one.
void level_near_roofs(const Plan& plan, std::vector<PlanContour>& contours, std::int64_t gap);

}  // namespace d2b
