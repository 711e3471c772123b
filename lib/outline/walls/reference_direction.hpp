#pragma once

#include <cstddef>
#include <cstdint>

#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// The chain whose direction another one follows: that on which it ends, or else the outline of the footprint
/// that it stands on. Its rank is lower.
/// @return WallGraph::nobody where there is none
[[nodiscard]] std::uint32_t reference_chain(const WallGraph& graph, const WallCluster& cluster,
                                            std::uint32_t chain);

/// The direction of a chain beside the reference's: the same where they agree but for some degrees, modulo 90
/// degrees, or where the chain is too short to have its own. Radians.
[[nodiscard]] double follow_direction(double own, double reference, std::size_t steps);

}  // namespace d2b
