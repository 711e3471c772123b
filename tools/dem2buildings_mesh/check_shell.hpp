// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "dem2buildings_mesh/shell.hpp"

namespace d2b::mesh {

/// Fault that keeps a shell from being a closed 2-manifold, and a point of it.
struct ShellFault {
    std::string what;  ///< "touches itself in an edge"
    std::uint32_t point = 0;
};

/// Each edge is passed once each way and no more, the triangles around each point form one fan, none of those
/// that face up or down is flat or turned in the plan, and no points are one. On integers.
[[nodiscard]] std::optional<ShellFault> fault_of(const Shell& shell);

/// A point that another one becomes when local coordinates are read in single precision.
[[nodiscard]] std::optional<std::uint32_t> merged_in_single(const Shell& shell, const SurfaceFrame& frame);

}  // namespace d2b::mesh
