#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// Fills small holes: 4-connected regions of zeros with fewer than `fewer_than` cells that do not touch the
/// border.
void fill_small_holes(Mask& mask, std::int64_t fewer_than, Executor& threads);

}  // namespace d2b
