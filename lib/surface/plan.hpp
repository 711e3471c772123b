#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// A contour that a surface is made of. Outlines lie on the lattice of the surface: columns are steps to the
/// east, rows are steps to the south, heights are steps upwards.
struct PlanContour {
    FinePolygon outline;
    std::int32_t parent = -1;   ///< place of the contour that it stands on, which comes before it; -1: none
    std::int32_t building = 0;  ///< place among the buildings
    std::int64_t top = 0;       ///< height of what no other contour covers
};

/// In place of a contour: nothing stands there.
inline constexpr std::int32_t open_ground = -1;

/// A piece of the border between two areas. It runs straight and touches others at its ends alone.
struct PlanEdge {
    std::uint32_t from = 0;  ///< node
    std::uint32_t to = 0;
    std::int32_t left = open_ground;  ///< contour that is on top there; never the same on both sides
    std::int32_t right = open_ground;

    friend auto operator<=>(const PlanEdge&, const PlanEdge&) = default;
};

/// A planar partition: which contour is on top where.
struct Plan {
    std::vector<FinePoint> nodes;  ///< distinct
    std::vector<PlanEdge> edges;
};

}  // namespace d2b
