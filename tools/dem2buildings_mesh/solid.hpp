// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "dem2buildings_mesh/city_model.hpp"

namespace d2b::mesh {

/// A plane polygon of a solid, its corners in steps; the exterior first.
struct SolidFace {
    FaceKind kind = FaceKind::roof;
    std::vector<std::vector<SurfacePoint>> rings;
};

/// Fault of a solid: ends a sentence that begins with its name. Nothing where every edge is passed
/// once each way, roofs and grounds are level and face up and down, walls stand upright, and the roofs cover
/// as much as the grounds. All of it is decided on integers. @param slanted true if roofs need only be plane,
/// within two steps of height
[[nodiscard]] std::optional<std::string> fault_of(const std::vector<SolidFace>& faces, bool slanted = false);

/// The roofs of a solid without fault, and its lowest ground.
[[nodiscard]] CityBuilding building_of(const std::vector<SolidFace>& faces);

}  // namespace d2b::mesh
