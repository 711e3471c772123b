#pragma once

#include <optional>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/drawn_chain.hpp"
#include "outline/walls/middles.hpp"

namespace d2b {

/// Puts a chain together from stretches of its walls and stretches that follow the trace closer. A wall goes
/// on up to where it stands for the step at which the next stretch begins.
/// @param walls the whole chain with walls; not used where no step has that form
/// @param ends of an open chain
[[nodiscard]] DrawnChain compose_chain(const WallSamples& samples, const CellShape& shape,
                                       LatticePoint origin, const ChainForm& form, const Middles& middles,
                                       const DrawnChain& walls, const std::optional<ChainEnds>& ends);

/// Gives a closer form to walls wherever they are farther from the trace than the limit.
/// @param form of the chain as it is drawn @return whether anything has changed
bool follow_where_far(const WallSamples& samples, const CellShape& shape, LatticePoint origin, double limit,
                      const DrawnChain& drawn, ChainForm& form);

}  // namespace d2b
