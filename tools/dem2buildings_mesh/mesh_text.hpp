// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "dem2buildings_mesh/mesh_file.hpp"

namespace d2b::mesh {

/// Takes the pieces of a file one after the other.
using TextSink = std::function<void(const std::string&)>;

/// STL in letters: a solid a building, then terrain, sides and plate.
void write_stl(const NamedShell& shell, const TextSink& sink);
/// OBJ: an object likewise, with groups roof, wall and ground. Corners stand first.
void write_obj(const NamedShell& shell, const TextSink& sink);
/// CityJSON 2.0: buildings as surfaces that share their vertices with a TINRelief per connected part of the
/// terrain.
void write_city_json(const NamedShell& shell, const TextSink& sink);

/// Calls for each run of triangles of one building, and of each part that belongs to none.
void for_each_object(
    const NamedShell& shell,
    const std::function<void(const std::string& name, std::span<const ShellTriangle>)>& take);

/// "12.25 -3.5 7.1": metres from the origin.
[[nodiscard]] std::string local_text(const SurfaceFrame& frame, const SurfacePoint& point);

}  // namespace d2b::mesh
