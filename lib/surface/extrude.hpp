#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// Input of an extrusion: each contour of a plan extends from the base to its top.
struct Standing {
    Plan plan;                               ///< contains only these contours; everything else is outside
    std::span<const std::int64_t> tops;      ///< by contour; above the base if the contour has an edge
    std::span<const std::int32_t> building;  ///< by contour
    std::int64_t base = 0;
};

/// Horizontal face.
struct LevelFace {
    std::int32_t building = 0;
    std::int64_t z = 0;
    PlanFace face;
};

/// Wall above an edge. Seen from outside, it extends between two vertical lines of vertices, left and right.
struct WallFace {
    std::int32_t building = 0;  ///< the higher building
    std::uint32_t left_node = 0;
    std::uint32_t right_node = 0;
    std::vector<std::int64_t> left;   ///< ascending heights, at least two
    std::vector<std::int64_t> right;  ///< ascending heights, with the same ends as `left`
};

/// Surface of the extruded plan. It is closed, because a wall has a vertex at every height at which a roof
/// next to one of its vertical edges ends.
struct Extrusion {
    std::vector<LevelFace> roofs;
    std::vector<LevelFace> grounds;  ///< one outline per building, as seen from above
    std::vector<WallFace> walls;     ///< sorted like the edges
};

[[nodiscard]] Extrusion extrude(const Standing& standing);

}  // namespace d2b
