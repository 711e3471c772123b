// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b::mesh {

/// Input, destination and rules of a mesh.
struct MeshRequest {
    std::string city;         ///< CityJSON that -surface has written
    std::string destination;  ///< .stl, .obj or .city.json
    bool overwrite = false;
    double min_angle = 20.7;                      ///< degrees
    double max_edge = 0;                          ///< metres; 0: no limit
    std::optional<std::array<double, 3>> origin;  ///< of local coordinates, metres; else by the city
    std::string ground;                           ///< raster of the terrain; "" for none
    bool keeps_undeclared = false;                ///< of its values, those that seem to stand for NoData
    double ground_error = 0.25;                   ///< metres
    double margin = 0;                            ///< metres
    double base = 10;                             ///< metres
    double min_wall = 0.5;                        ///< metres
};

/// A place that a report names, in coordinates of the CRS.
struct NamedPlace {
    Position at;
    double figure = 0;     ///< degrees, or metres
    std::string building;  ///< "" for none
};

/// Figures of a finished mesh.
struct MeshReport {
    std::int64_t buildings = 0;
    std::int64_t footprint_points = 0;  ///< distinct corners of the footprints
    std::int64_t plan_points = 0;
    std::int64_t points = 0;
    std::int64_t triangles = 0;
    double smallest_angle = 0;           ///< degrees, of roofs, bases and terrain as seen from above
    std::vector<NamedPlace> small;       ///< corners of their triangles below MeshRequest::min_angle
    double smallest_wall_angle = 0;      ///< degrees, of the walls' triangles
    std::int64_t small_walls = 0;        ///< of these, below MeshRequest::min_angle
    double longest_edge = 0;             ///< metres
    std::array<double, 3> origin{};      ///< metres
    std::vector<NamedPlace> pinches;     ///< where buildings that touched in an edge were parted
    std::vector<NamedPlace> lifted;      ///< roofs, by how much
    std::optional<double> ground_error;  ///< largest, metres; nothing without terrain
    std::int64_t ground_cells = 0;       ///< outside the footprints
    std::vector<NamedPlace> missed;  ///< of these, farther off than MeshRequest::ground_error, by how much
};

}  // namespace d2b::mesh
