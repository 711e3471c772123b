#pragma once

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Finds roofs that have become connected ground although nothing leads up to them: those of a mall are wider
/// than most elements, so their lower parts are cut off by none that would notice, and the rest goes on from
/// there. A plateau is all that hangs together by steps that ground may take; it is a roof where it is no
/// longer than the widest walled building and falls by a wall on nearly all of its border. What leads down to
/// a street somewhere is as long as the street.
/// @param limits the height above which a block was an object before it was connected
/// @param ground 1 where a block is connected ground
/// @param largest metres
/// @return 1 where a block belongs to such a roof
[[nodiscard]] Mask walled_plateaus(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground,
                                   const Rules& rules, double largest);

}  // namespace d2b::ground
