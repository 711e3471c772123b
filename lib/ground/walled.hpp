#pragma once

#include <cstdint>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Takes back what has become connected ground over a ramp, a canopy or a tree, but stands behind walls on
/// nearly all sides: a roof. Hills and terraces go on without a step somewhere. A piece that is longer than
/// the widest walled building stays ground, so that the support is bounded.
/// @param limits the height above which a block was an object before it was connected
/// @param ground 1 where a block is connected ground; changed
/// @param largest metres
void take_walled_back(const AlignedGrid& blocks, const MetreGrid& limits, const Rules& rules, double largest,
                      Grid<std::uint8_t>& ground);

}  // namespace d2b::ground
