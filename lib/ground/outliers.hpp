#pragma once

#include <cstdint>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// The height below which a point of a cell is a low outlier, such as a pulse that came back by detours:
/// `-no_value` where none is. A pit counts only where it lies below all ground around it: alleys and courts
/// lie as deep below the roofs beside them, but as high as the next street.
[[nodiscard]] MetreGrid outlier_limits(const AlignedGrid& lowest, const Rules& rules);

}  // namespace d2b::ground
