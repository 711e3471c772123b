#pragma once

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Finds roofs that became connected ground although nothing leads up to them. Roofs of a mall are wider than
/// most elements: their lower parts are never cut off, and ground grows from there to the rest. A plateau is
/// a component of blocks connected by slopes that ground may have. It is a roof if it is not longer than the
/// widest walled building and drops by a wall along nearly all of its border. A component that leads down to
/// a street is as long as the street.
/// @param limits height above which a block was an object before it was connected
/// @param ground 1 for connected ground
/// @param largest metres
/// @return 1 for blocks of such a roof
[[nodiscard]] Mask walled_plateaus(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground,
                                   const Rules& rules, double largest);

}  // namespace d2b::ground
