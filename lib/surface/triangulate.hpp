#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// Three vertices, in either orientation.
using FineTriangle = std::array<FinePoint, 3>;

/// Triangulates a polygon without new vertices. May throw GeometryError, and may be wrong.
using Triangulate = std::function<std::vector<FineTriangle>(const FinePolygon& polygon)>;

/// Three nodes, counter-clockwise (y up).
using PlanTriangle = std::array<std::uint32_t, 3>;

/// Triangulates a face and verifies the result: every triangle has an area, and after cancelling edges
/// traversed in both directions exactly the face's boundary remains. Retries with rows and columns swapped,
/// then in y-monotone pieces. @return nothing if everything fails
[[nodiscard]] std::optional<std::vector<PlanTriangle>> triangulate_face(const PlanFace& face,
                                                                        const Plan& plan,
                                                                        const Triangulate& triangulate);

}  // namespace d2b
