#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "surface/plan.hpp"
#include "surface/plan_faces.hpp"

namespace d2b {

/// What stands on a plan: what lies between the base and the top of each contour.
struct Standing {
    Plan plan;                               ///< of the contours that stand there, all else is outside
    std::span<const std::int64_t> tops;      ///< by contour, above the base where it has an edge
    std::span<const std::int32_t> building;  ///< of each contour
    std::int64_t base = 0;
};

/// A horizontal face.
struct LevelFace {
    std::int32_t building = 0;
    std::int64_t z = 0;
    PlanFace face;
};

/// A wall over an edge: seen from outside it rises between two columns of corners, from left to right.
struct WallFace {
    std::int32_t building = 0;  ///< the higher one
    std::uint32_t left_node = 0;
    std::uint32_t right_node = 0;
    std::vector<std::int64_t> left;   ///< ascending heights, at least two
    std::vector<std::int64_t> right;  ///< likewise, with the same ends
};

/// The surface of what stands there. It is closed: a wall has a corner at every height at which a roof beside
/// one of its vertical edges ends.
struct Extrusion {
    std::vector<LevelFace> roofs;
    std::vector<LevelFace> grounds;  ///< a building's in one, as seen from above
    std::vector<WallFace> walls;     ///< in the order of the edges
};

[[nodiscard]] Extrusion extrude(const Standing& standing);

}  // namespace d2b
