// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "dem2buildings/surfaces.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "dem2buildings_mesh/city_model.hpp"

namespace d2b::mesh {

/// Points that are added lie between the steps of the file, on parts of these.
inline constexpr std::int64_t parts_a_step = std::int64_t{1} << 14;

/// Maps steps of a file to the plane that is divided into triangles, and on to the steps of the mesh. The
/// plane's unit is the file's step to the east, so that corners of square cells stay whole numbers.
struct PlanFrame {
    FinePoint corner;      ///< of the file, at 0 0 of the plane
    double ratio = 1;      ///< step to the north by step to the east
    SurfaceFrame surface;  ///< of the mesh; its horizontal steps are parts of the file's

    /// Metres in a unit of the plane.
    [[nodiscard]] double metres() const {
        return surface.scale[0] * static_cast<double>(parts_a_step) * surface.horizontal_metres;
    }
    /// Metres in a step of height.
    [[nodiscard]] double metres_of_height() const { return surface.scale[2] * surface.vertical_metres; }
    [[nodiscard]] Position plane(FinePoint point) const {
        return {static_cast<double>(point.col - corner.col),
                static_cast<double>(corner.row - point.row) * ratio};
    }
    /// Column and row of the file, as x and y.
    [[nodiscard]] Position lattice(const Position& at) const {
        return {static_cast<double>(corner.col) + at.x, static_cast<double>(corner.row) - at.y / ratio};
    }
    /// Rounded to parts of a step. @param z in steps
    [[nodiscard]] SurfacePoint steps(const Position& at, std::int64_t z) const {
        return {corner.col * parts_a_step + std::llround(at.x * static_cast<double>(parts_a_step)),
                -corner.row * parts_a_step + std::llround(at.y / ratio * static_cast<double>(parts_a_step)),
                z};
    }
    /// Position in the units of the CRS.
    [[nodiscard]] Position world(const Position& at) const {
        const double x = static_cast<double>(corner.col) + at.x;
        const double y = at.y / ratio - static_cast<double>(corner.row);
        const auto parts = static_cast<double>(parts_a_step);
        return {surface.translate[0] + x * (surface.scale[0] * parts),
                surface.translate[1] + y * (surface.scale[1] * parts)};
    }
    /// Back from the units of the CRS.
    [[nodiscard]] Position plane(const Position& world) const {
        const auto parts = static_cast<double>(parts_a_step);
        return {
            (world.x - surface.translate[0]) / (surface.scale[0] * parts) - static_cast<double>(corner.col),
            ((world.y - surface.translate[1]) / (surface.scale[1] * parts) +
             static_cast<double>(corner.row)) *
                ratio};
    }
};

}  // namespace d2b::mesh
