#pragma once

#include <cstddef>
#include <cstdint>

#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Chain whose direction another chain follows: the one on which it ends, or else the outline of the
/// footprint below it. Its rank is lower.
/// @return WallGraph::nobody if there is none
[[nodiscard]] std::uint32_t reference_chain(const WallGraph& graph, const WallCluster& cluster,
                                            std::uint32_t chain);

/// Returns the reference direction if the directions agree within some degrees modulo 90, or if the chain is
/// too short to have a direction of its own; otherwise the chain's own direction. Radians.
[[nodiscard]] double follow_direction(double own, double reference, std::size_t steps);

}  // namespace d2b
