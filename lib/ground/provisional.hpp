#pragma once

#include <span>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Where the surface is no object: its own height; `no_value` elsewhere.
[[nodiscard]] AlignedGrid without_objects(const AlignedGrid& surface, double width, const Rules& rules,
                                          Executor& threads);

/// The terrain of the working grid, without gaps: what lies near the provisional terrain is ground (SMRF's
/// last test), the rest is filled again. Memory: 4 bytes a cell, as much as the surface; beside them 7 at
/// most.
[[nodiscard]] AlignedGrid working_terrain(const AlignedGrid& surface, double width, const Rules& rules,
                                          Executor& threads);

/// The slopes of a row in metres a metre, from the cells beside; at the border from the cell itself.
void slopes_of_row(const MetreGrid& terrain, std::int32_t row, const CellSize& cell, std::span<float> slopes);

}  // namespace d2b::ground
