// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "dem2buildings_mesh/ground_grid.hpp"
#include "dem2buildings_mesh/mesh_request.hpp"
#include "dem2buildings_mesh/plan_frame.hpp"
#include "dem2buildings_mesh/plan_mesh.hpp"
#include "dem2buildings_mesh/stand_up.hpp"

namespace d2b::mesh {

/// Puts open ground around a drawing: a rectangle of the raster's cells and of all footprints, and a margin.
/// Cells under footprints say nothing of the terrain from here on.
/// @return nodes of the drawing that lie more than a cell outside of the raster
std::size_t lay_ground(PlanDrawing& drawing, GroundGrid& grid, double margin_metres, const PlanFrame& frame);

/// Function for RefineRules::too_coarse: finds triangles that are too far from a cell, or have edges too long
/// on the slope. Those below a 64th of a cell are left as they are: only where the terrain
/// rises by more than 40 errors from a cell to the next one can that matter.
[[nodiscard]] std::function<bool(const std::array<Position, 3>&)> too_far_from(const GroundGrid& grid,
                                                                               const MeshRequest& request,
                                                                               const PlanFrame& frame);

/// Heights of the terrain at all nodes, of a plate below, and of roofs, which are lifted where the terrain
/// beside them comes too near. @param report gets these
[[nodiscard]] PlanHeights heights_over(const PlanMesh& mesh, std::vector<Region> regions,
                                       const GroundGrid& grid, const MeshRequest& request,
                                       const PlanFrame& frame, const CityModel& city, MeshReport& report);

/// How far the terrain is from the cells. @param report gets it
void measure_terrain(const PlanMesh& mesh, const PlanHeights& heights, const GroundGrid& grid,
                     const MeshRequest& request, const PlanFrame& frame, MeshReport& report);

}  // namespace d2b::mesh
