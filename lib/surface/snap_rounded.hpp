#pragma once

#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// Of outlines that were rounded to a lattice after they had been made: a corner that lay hardly beside an
/// edge may have come to lie on its other side, so that outlines cross by less than a step. Where contours
/// are at odds all edges are led through every corner that lies within a step of them, as often as that makes
/// new neighbours, but no more than some rounds. Corners stay where they are, and walls that outlines have in
/// common are still common.
void snap_rounded(std::vector<PlanContour>& contours);

}  // namespace d2b
