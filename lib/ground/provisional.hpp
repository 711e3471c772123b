#pragma once

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Where the surface is no object: its own height; `no_value` elsewhere.
[[nodiscard]] AlignedGrid without_objects(const AlignedGrid& surface, double width, const Rules& rules);

/// The terrain of the working grid, without gaps: what lies near the provisional terrain is ground (SMRF's
/// last test), the rest is filled again.
[[nodiscard]] AlignedGrid working_terrain(const AlignedGrid& surface, double width, const Rules& rules);

/// Metres a metre, from the cells beside; at the border from the cell itself.
[[nodiscard]] MetreGrid slopes(const AlignedGrid& terrain);

}  // namespace d2b::ground
