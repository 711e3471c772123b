#pragma once

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/detection.hpp"

namespace d2b::detect {

/// Marks objects of which half or more lies in a mask of 0 and 1. They keep their cells, because units must
/// agree on them at seams; merging the units drops them. LeftOut::excluded does not apply to objects that an
/// editor has confirmed, or has denied already.
void mark_left_out(const Mask& where, LeftOut reason, Detection& detection, Executor& threads);

}  // namespace d2b::detect
