// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::mesh {

/// Region outside of the terrain.
inline constexpr std::int32_t beyond = -2;

/// Partition of the plane, to be divided into triangles. Lengths are steps of the plan, x to the
/// east and y to the north.
struct PlanDrawing {
    std::vector<Position> nodes;
    std::vector<surface::PartitionEdge> edges;  ///< sides are regions, open_ground or beyond
    bool with_ground = false;                   ///< whether open ground is divided, too
};

struct PlanTriangle {
    std::array<std::uint32_t, 3> nodes{};  ///< counter-clockwise
    std::int32_t region = surface::open_ground;
};

struct PlanMesh {
    std::vector<Position> nodes;  ///< by x, then y
    std::vector<PlanTriangle> triangles;
};

/// Rules that triangles have to keep.
struct RefineRules {
    double min_angle = 20.7;  ///< degrees
    double max_edge = 0;      ///< steps; 0: no limit
    /// Tells whether a triangle has to be divided for another reason; may be empty.
    std::function<bool(const std::array<Position, 3>&)> too_coarse = {};
};

/// The angle below which Delaunay refinement ends wherever the angles of the input allow it: the sine of it
/// is the root of an eighth.
inline constexpr double sure_angle = 20.7;

/// Beyond the sure angle: how many times the points that the sure angle takes.
inline constexpr std::size_t most_points_a_point = 10;

/// Least number of points of triangles without longer edges, on the divided part of a plan and
/// on its edges. @param most steps
[[nodiscard]] double fewest_points(const PlanDrawing& drawing, double most);

/// Edges longer than a length in equal parts. @param most steps
void split_long_edges(PlanDrawing& drawing, double most);

/// An angle of a triangle and the corner that it is at.
struct CornerAngle {
    double degrees = 180;
    std::size_t corner = 0;
};

[[nodiscard]] CornerAngle smallest_angle(const std::array<Position, 3>& corners);

}  // namespace d2b::mesh
