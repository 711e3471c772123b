#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Contour to build a surface from. Outlines lie on the surface's lattice: columns are steps to the east,
/// rows are steps to the south, heights are steps upwards.
struct PlanContour {
    FinePolygon outline;
    std::int32_t parent = -1;   ///< index of the contour that it stands on, which comes before it; -1: none
    std::int32_t building = 0;  ///< index of its building
    std::int64_t top = 0;       ///< height of its roof outside its children
};

/// Stands for a contour: nothing is built there.
inline constexpr std::int32_t open_ground = -1;

/// Part of the boundary between two areas: straight, and touching other edges only at its ends.
struct PlanEdge {
    std::uint32_t from = 0;  ///< node
    std::uint32_t to = 0;
    std::int32_t left = open_ground;  ///< topmost contour on this side; never equal to right
    std::int32_t right = open_ground;

    friend auto operator<=>(const PlanEdge&, const PlanEdge&) = default;
};

/// Planar partition by topmost contour.
struct Plan {
    std::vector<FinePoint> nodes;  ///< distinct
    std::vector<PlanEdge> edges;
};

}  // namespace d2b
