#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// Sets the cells of holes: regions of zeros, connected by edges, that do not reach the border and have fewer
/// cells.
void fill_small_holes(Mask& mask, std::int64_t fewer_than, Executor& threads);

}  // namespace d2b
