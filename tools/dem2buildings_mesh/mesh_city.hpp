// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings_mesh/mesh_request.hpp"

namespace d2b::mesh {

/// city file -> plan -> triangles of the plan -> heights -> one closed surface -> file
/// @throws OptionError, InputError, OutputError
MeshReport mesh_city(const MeshRequest& request, const Callbacks& callbacks,
                     const ReportReader<MeshReport>& reader = {});

}  // namespace d2b::mesh
