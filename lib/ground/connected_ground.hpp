#pragma once

#include <cstdint>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Grows ground from blocks that are ground to neighbours without a step, for a limited number of steps. This
/// restores hilltops and terraces that an opening removed. Roofs stay removed because walls separate them
/// from the ground.
/// @param limits height above which a block is an object
/// @param slope steepest slope between neighbours, metres per metre
/// @return 1 for connected ground
[[nodiscard]] Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits,
                                                  double slope, int steps, Executor& threads);

/// Removes roofs that became connected ground over a ramp, a canopy or a tree: pieces with walls along nearly
/// all of their border; on coarse cells three fifths of it if they are large and level. Hills and terraces
/// continue without a step somewhere. A piece longer than the widest walled building stays ground, because
/// the support must be bounded.
/// @param limits height above which a block was an object before it was connected
/// @param ground 1 for connected ground; modified
/// @param largest metres
void remove_enclosed_by_walls(const AlignedGrid& blocks, const MetreGrid& limits, const Rules& rules,
                              double largest, Mask& ground, Executor& threads);

/// Finds roofs that became connected ground although nothing leads up to them. Roofs of a mall are wider than
/// most elements: their lower parts are never cut off, and ground grows from there to the rest. A plateau is
/// a component of blocks connected by slopes that ground may have. It is a roof if it is not longer than the
/// widest walled building and drops by a wall along nearly all of its border. A component that leads down to
/// a street is as long as the street.
/// @param limits height above which a block was an object before it was connected
/// @param ground 1 for connected ground
/// @param largest metres
/// @return 1 for blocks of such a roof
[[nodiscard]] Mask enclosed_plateaus(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground,
                                     const Rules& rules, double largest);

}  // namespace d2b::ground
