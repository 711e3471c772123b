#pragma once

#include <cstdint>

#include "ground/aligned_grid.hpp"

namespace d2b::ground {

/// Ground goes on where the surface does: from blocks that are ground to neighbours that are no step higher
/// or lower, a limited number of times. So hilltops and terraces come back that an opening cut off; roofs do
/// not, as their walls part them from the ground.
/// @param limits the height above which a block is an object
/// @param slope the steepest way from a block to its neighbour, metres a metre
/// @return 1 where a block is connected ground
[[nodiscard]] Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits,
                                                  double slope, int steps, Executor& threads);

}  // namespace d2b::ground
