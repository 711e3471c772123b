#pragma once

#include "ground/ground.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Same as estimate_ground() with given rules. @param width of the widest building, metres
[[nodiscard]] Terrain estimate(MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                               const GridPlace& place, const Rules& rules);

/// Same as ground_halo() with given rules.
[[nodiscard]] double halo(const CellSize& cell, double width, const Rules& rules);

}  // namespace d2b::ground
