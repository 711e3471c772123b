#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// Polygon of nodes: exterior counter-clockwise (y up), interiors clockwise. Rings do not touch themselves
/// and touch each other only in single nodes.
struct PlanFace {
    std::vector<std::uint32_t> exterior;
    std::vector<std::vector<std::uint32_t>> interiors;

    friend auto operator<=>(const PlanFace&, const PlanFace&) = default;
};

/// Face and its topmost contour.
struct OwnedFace {
    std::int32_t owner = open_ground;
    PlanFace face;
};

/// Returns the faces of a plan, except the outside, by ascending owners.
[[nodiscard]] std::vector<OwnedFace> plan_faces(const Plan& plan);

/// Returns the face as a polygon on the lattice. @param plan that the face belongs to
[[nodiscard]] FinePolygon polygon_of(const PlanFace& face, const Plan& plan);

}  // namespace d2b
