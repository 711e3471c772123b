#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// A polygon of nodes: the exterior counter-clockwise (y up), interiors clockwise. Rings touch themselves
/// nowhere, each other in single nodes at most.
struct PlanFace {
    std::vector<std::uint32_t> exterior;
    std::vector<std::vector<std::uint32_t>> interiors;

    friend auto operator<=>(const PlanFace&, const PlanFace&) = default;
};

/// A face and the contour that is on top in it.
struct OwnedFace {
    std::int32_t owner = open_ground;
    PlanFace face;
};

/// The faces of a plan but those of the outside, by ascending owners.
[[nodiscard]] std::vector<OwnedFace> plan_faces(const Plan& plan);

/// A face on the lattice. @param plan that it is of
[[nodiscard]] FinePolygon polygon_of(const PlanFace& face, const Plan& plan);

}  // namespace d2b
