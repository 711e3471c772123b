#pragma once

#include <cstdint>
#include <functional>

#include "surface/flow_limits.hpp"
#include "surface/partition_editor.hpp"

namespace d2b::surface {

/// Removes corners at which a wall goes straight on within a millimetre, or within a step of the lattice if
/// that is longer. Corners of more than two walls stay. A wall moves by no more than that, however many
/// corners it loses.
/// @param may_go returns true if a node may be removed
void take_needless_corners(PartitionEditor& plan, const FlowMetric& metric,
                           const std::function<bool(std::uint32_t)>& may_go);

}  // namespace d2b::surface
