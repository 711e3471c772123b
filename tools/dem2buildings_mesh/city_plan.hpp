// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem2buildings_mesh/city_model.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::mesh {

/// A roof in the plan of a city.
struct Region {
    std::int32_t building = 0;  ///< place in CityModel::buildings
    std::int64_t top = 0;       ///< steps of the file
    std::int64_t base = 0;      ///< lowest ground of all buildings that hang together with this one
    std::optional<surface::RoofPlane> plane = {};  ///< if it is slanted; `top` is its lowest corner then
};

/// The roofs of a city as a partition of the plane, exactly on the steps of its file. Sides of an edge are
/// regions, or open_ground.
struct CityPlan {
    surface::PlanarPartition plan;
    std::vector<Region> regions;
    std::vector<FinePoint> pinches;  ///< places where it was changed by a few steps
};

/// @param gaps of the file's steps
///
/// Where a vertical edge would have more than two walls, corners move apart, as -surface has it: a file that
/// -surface has written has no such place. @throws InputError two roofs over one place, no room to move
/// corners
[[nodiscard]] CityPlan make_city_plan(const CityModel& city, const surface::GapTolerances& gaps);

}  // namespace d2b::mesh
