#pragma once

#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// Divides a face along diagonals between its nodes into faces without interiors that every line along a row
/// meets in one piece (de Berg, Cheong, van Kreveld and Overmars 2008, 3.2). Exact; O(n log n), but for the
/// moving of what a line meets. @param face whose rings do not touch
[[nodiscard]] std::vector<PlanFace> divide_face(const PlanFace& face, const Plan& plan);

}  // namespace d2b
