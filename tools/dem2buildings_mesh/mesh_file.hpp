// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "dem2buildings_mesh/city_model.hpp"
#include "dem2buildings_mesh/mesh_request.hpp"
#include "dem2buildings_mesh/plan_frame.hpp"
#include "dem2buildings_mesh/shell.hpp"
#include "write/file_target.hpp"
#include "write/file_writer.hpp"

namespace d2b::mesh {

/// A shell with the model and the frame that it belongs to.
struct NamedShell {
    const CityModel& city;
    const SurfaceFrame& frame;
    const Shell& shell;
};

/// Destination of the mesh. @throws OptionError: not .stl, .obj or .city.json, exists, is read by this run.
/// @throws OutputError
[[nodiscard]] writing::FileDestination locate_mesh(const MeshRequest& request);

/// Whether local coordinates are written, in metres from an origin.
[[nodiscard]] bool is_local(const std::string& destination);

/// Writes it. @param file is prepared to be shown, whole or not at all @throws OutputError
void write_mesh(const NamedShell& shell, const std::string& destination, writing::FileWriter& file);

}  // namespace d2b::mesh
