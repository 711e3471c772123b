#pragma once

#include <cstdint>

#include "ground/aligned_grid.hpp"

namespace d2b::ground {

/// Grows ground from blocks that are ground to neighbours without a step, for a limited number of steps. This
/// restores hilltops and terraces that an opening removed. Roofs stay removed because walls separate them
/// from the ground.
/// @param limits height above which a block is an object
/// @param slope steepest slope between neighbours, metres per metre
/// @return 1 for connected ground
[[nodiscard]] Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits,
                                                  double slope, int steps, Executor& threads);

}  // namespace d2b::ground
