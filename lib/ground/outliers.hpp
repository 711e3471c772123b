#pragma once

#include <cstdint>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// A cell of the working grid whose points below a height are low outliers, such as pulses that came back by
/// detours.
struct Pit {
    std::int32_t row = 0;
    std::int32_t col = 0;
    float limit = 0;
};

/// A pit counts only where it lies below all ground around it: alleys and courts lie as deep below the roofs
/// beside them, but as high as the next street. @return in scan order
[[nodiscard]] std::vector<Pit> find_pits(const AlignedGrid& lowest, const Rules& rules, Executor& threads);

}  // namespace d2b::ground
