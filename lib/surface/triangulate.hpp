#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// Three corners, in either direction.
using FineTriangle = std::array<FinePoint, 3>;

/// Divides a polygon into triangles on its own corners; may fail with a GeometryError, and may be wrong.
using Triangulate = std::function<std::vector<FineTriangle>(const FinePolygon& polygon)>;

/// Three nodes, counter-clockwise (y up).
using PlanTriangle = std::array<std::uint32_t, 3>;

/// The triangles of a face, checked: each has an area, and what is left of their edges, where those that two
/// of them pass in opposite directions go, is the border of the face. What fails is tried once more with rows
/// and columns exchanged, and then in pieces without interiors. @return nothing where all fail
[[nodiscard]] std::optional<std::vector<PlanTriangle>> triangulate_face(const PlanFace& face,
                                                                        const Plan& plan,
                                                                        const Triangulate& triangulate);

}  // namespace d2b
