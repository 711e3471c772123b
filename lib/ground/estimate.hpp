#pragma once

#include "ground/ground.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// estimate_ground with other rules than the defaults. @param width of the widest building, metres
[[nodiscard]] Terrain estimate(MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                               const GridPlace& place, const Rules& rules);

/// ground_halo with other rules than the defaults.
[[nodiscard]] double halo(const CellSize& cell, double width, const Rules& rules);

}  // namespace d2b::ground
