#pragma once

#include <optional>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/drawn_chain.hpp"
#include "outline/walls/middles.hpp"

namespace d2b {

/// Composes a chain from stretches of walls and stretches that follow the trace more closely. A wall extends
/// to the point that corresponds to the first step of the next stretch.
/// @param walls the whole chain drawn with walls; unused if no step has that mode
/// @param ends of an open chain
[[nodiscard]] DrawnChain compose_chain(const WallSamples& samples, const CellShape& shape,
                                       LatticePoint origin, const ChainForm& form, const Middles& middles,
                                       const DrawnChain& walls, const std::optional<ChainEnds>& ends);

/// Switches walls to a closer mode wherever they are farther from the trace than the limit.
/// @param form of the chain as drawn @return true if anything has changed
bool follow_where_far(const WallSamples& samples, const CellShape& shape, LatticePoint origin, double limit,
                      const DrawnChain& drawn, ChainForm& form);

}  // namespace d2b
