#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace d2b {

/// The cells of one building with their elevations.
struct BuildingCells {
    struct Run {
        std::int32_t row = 0;
        std::int32_t begin = 0;  ///< columns
        std::int32_t end = 0;
        [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
    };
    std::vector<Run> runs;  ///< in scan order; of a row no two touch
    std::vector<double>
        elevations;  ///< of the runs' cells, one after the other; NaN where a point is not valid
};

}  // namespace d2b
