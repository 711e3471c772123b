#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// The share of the cells that no pulse met and that were given the height of a neighbour, as surveys do:
/// what tells how thin the points are. It is seen where the surface is rough, on crowns and clutter: there
/// two neighbours are equal by chance no more often than they differ by any other small number. Pairs of
/// neighbours are counted whose cells are elevated and bend whichever way one looks. 0 where there are too
/// few of them, and where heights are rounded, so that equal ones say nothing. Sums in whole numbers: their
/// order does not matter.
/// @param flags of smoothness()
[[nodiscard]] double filled_share(const MetreGrid& surface, const Mask& elevated,
                                  const Grid<std::uint8_t>& flags, Executor& threads);

}  // namespace d2b
