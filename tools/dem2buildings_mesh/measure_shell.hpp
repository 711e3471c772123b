// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dem2buildings_mesh/mesh_file.hpp"

namespace d2b::mesh {

/// Fills in a report's figures of the points, triangles, angles and edges of a shell.
void measure_shell(const NamedShell& shell, double min_angle, MeshReport& report);

}  // namespace d2b::mesh
