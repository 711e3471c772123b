// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/lattice.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::mesh {

/// A roof. Its outline is on the whole steps of the file: columns to the east, rows to the south.
struct CityRoof {
    FinePolygon outline;
    std::int64_t z = 0;                            ///< of its lowest corner
    std::optional<surface::RoofPlane> plane = {};  ///< if it is slanted
};

/// A building as one closed solid with vertical walls.
struct CityBuilding {
    std::string name;        ///< its key in the file
    std::string attributes;  ///< a JSON object, "" for none
    std::vector<CityRoof> roofs;
    std::int64_t base = 0;   ///< height of its lowest ground
    std::string whole = {};  ///< key of the divided building that it is a part of; "" where it is one itself
};

/// Content of a CityJSON file of buildings. Coordinates are translate + step * scale, in units of the CRS.
struct CityModel {
    std::string name;  ///< of the file, for messages
    std::array<double, 3> scale{1, 1, 1};
    std::array<double, 3> translate{};
    std::string reference_system;  ///< a URL of the OGC; "" for none
    std::string lod;
    std::vector<CityBuilding> buildings;  ///< by the length of their names, then by these
};

/// "84012.5 446103.25", of a corner. For messages.
[[nodiscard]] std::string place_text(const CityModel& city, FinePoint point);

}  // namespace d2b::mesh
