#pragma once

#include <cstdint>
#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_gaps.hpp"

namespace d2b {

/// Merges nodes closer than a gap, if nothing lies between them, because programs that read solids merge them
/// and then find broken faces. The plan stays planar; exact.
void merge_near_nodes(Plan& plan, const LatticeGap& gap);

/// Raises roofs that share a node to the higher one if they differ by less than a gap, because the corners of
/// such a low wall would be merged by readers.
void level_near_roofs(const Plan& plan, std::vector<PlanContour>& contours, std::int64_t gap);

}  // namespace d2b
