// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "dem2buildings_mesh/mesh_request.hpp"

namespace d2b::mesh {

/// A figure a line, and the first of the places.
[[nodiscard]] std::string mesh_text(const MeshRequest& request, const MeshReport& report);

/// A JSON object with a line feed at its end; keys always in the same order, null for missing values.
[[nodiscard]] std::string mesh_json(const MeshRequest& request, const MeshReport& report,
                                    const std::vector<std::string>& warnings);

}  // namespace d2b::mesh
