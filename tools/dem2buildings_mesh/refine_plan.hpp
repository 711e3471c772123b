// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/plan_mesh.hpp"

namespace d2b::mesh {

/// Edges cross, or disagree on the region between them.
struct PlanFault : GeometryError {
    explicit PlanFault(const Position& place) : GeometryError("The plan is not a partition."), at(place) {}
    Position at;
};

/// Divides a plan into triangles that are as large as the rules allow, by Delaunay refinement (Shewchuk 1997)
/// with CGAL: points are added on the edges of the plan and beside them, so that all regions conform. Angles
/// are kept wherever those of the input allow it, above sure_angle as far as most_points_a_point goes.
/// The only place that knows CGAL.
/// @throws PlanFault
[[nodiscard]] PlanMesh refine_plan(const PlanDrawing& drawing, const RefineRules& rules);

}  // namespace d2b::mesh
