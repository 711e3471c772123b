#pragma once

#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// Divides a face along diagonals into y-monotone pieces without interiors (de Berg, Cheong, van Kreveld and
/// Overmars 2008, 3.2). Exact. O(n log n), except for shifting the vector of edges on the sweep line. @param
/// face whose rings do not touch
[[nodiscard]] std::vector<PlanFace> divide_face(const PlanFace& face, const Plan& plan);

}  // namespace d2b
