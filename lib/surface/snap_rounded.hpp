#pragma once

#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// Repairs outlines after rounding to a lattice: a vertex close to an edge may have moved to its other side,
/// so that outlines cross by less than a step. While contours conflict, routes every edge through all
/// vertices within a step of it, for a limited number of rounds. Vertices do not move, and common walls stay
/// common. Related to iterated snap rounding (Halperin and Packer 2002).
void snap_rounded(std::vector<PlanContour>& contours);

}  // namespace d2b
