#pragma once

#include <cstdint>
#include <functional>

#include "flow/flow_limits.hpp"
#include "surface/partition_editor.hpp"

namespace d2b {

/// Takes away corners at which a wall runs on straight within a millimetre, or within a step of the lattice
/// where that is longer. Corners at which more than two walls meet stay. No wall leaves what it was by more,
/// however many of its corners go.
/// @param may_go whether a node may
void take_needless_corners(PartitionEditor& plan, const FlowMetric& metric,
                           const std::function<bool(std::uint32_t)>& may_go);

}  // namespace d2b
