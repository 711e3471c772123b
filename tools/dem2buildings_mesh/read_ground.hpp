// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/crs.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings_mesh/city_model.hpp"
#include "dem2buildings_mesh/ground_grid.hpp"
#include "dem2buildings_mesh/mesh_request.hpp"
#include "dem2buildings_mesh/plan_frame.hpp"

namespace d2b::mesh {

/// Reads the raster of the terrain in the CRS and the unit of a city, over the plane of its plan. Without a
/// CRS in either, coordinates are taken as the same.
/// @throws InputError cannot be opened, has no elevations, lies elsewhere
[[nodiscard]] GroundGrid read_ground(const MeshRequest& request, const CityModel& city, const Crs& crs,
                                     const PlanFrame& frame, const Callbacks& callbacks);

}  // namespace d2b::mesh
