#pragma once

#include <cstdint>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Cell of the working grid with low outliers below a height, such as pulses delayed by multiple reflections.
struct LowOutlier {
    std::int32_t row = 0;
    std::int32_t col = 0;
    float limit = 0;
};

/// Finds low outliers: cells below all ground around them. Alleys and courts also lie far below the adjacent
/// roofs but as high as the next street, so they are kept. @return in scan order
[[nodiscard]] std::vector<LowOutlier> find_low_outliers(const AlignedGrid& lowest, const Rules& rules,
                                                        Executor& threads);

}  // namespace d2b::ground
