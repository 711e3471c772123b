#pragma once

#include <span>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Returns the surface with `no_value` in cells of objects.
[[nodiscard]] AlignedGrid remove_objects(const AlignedGrid& surface, double width, const Rules& rules,
                                         Executor& threads);

/// Returns the terrain of the working grid without gaps: points near the provisional terrain are ground (last
/// test of SMRF), the rest is filled again. Memory: 4 bytes per cell, as much as the surface, and at most 7
/// more temporarily.
[[nodiscard]] AlignedGrid working_terrain(const AlignedGrid& surface, double width, const Rules& rules,
                                          Executor& threads);

/// Computes the slopes of a row in metres per metre by central differences; one-sided at the border.
void slopes_of_row(const MetreGrid& terrain, std::int32_t row, const CellSize& cell, std::span<float> slopes);

}  // namespace d2b::ground
