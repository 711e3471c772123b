// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem2buildings/surfaces.hpp"

namespace d2b::mesh {

/// Part of the shell that a triangle belongs to.
enum class ShellPart { roof, wall, ground, terrain, sides, plate };

struct ShellTriangle {
    ShellPart part = ShellPart::roof;
    std::int32_t building = -1;             ///< place in CityModel::buildings; -1: none
    std::array<std::uint32_t, 3> points{};  ///< counter-clockwise seen from outside
};

/// A closed surface in triangles.
struct Shell {
    std::vector<SurfacePoint> points;      ///< distinct
    std::vector<ShellTriangle> triangles;  ///< by building, those of none last; then by part
};

}  // namespace d2b::mesh
