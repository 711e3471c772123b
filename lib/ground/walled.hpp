#pragma once

#include <cstdint>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Removes roofs that became connected ground over a ramp, a canopy or a tree: pieces with walls along nearly
/// all of their border. Hills and terraces continue without a step somewhere. A piece longer than the widest
/// walled building stays ground, because the support must be bounded.
/// @param limits height above which a block was an object before it was connected
/// @param ground 1 for connected ground; modified
/// @param largest metres
void take_walled_back(const AlignedGrid& blocks, const MetreGrid& limits, const Rules& rules, double largest,
                      Grid<std::uint8_t>& ground);

}  // namespace d2b::ground
