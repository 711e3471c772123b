#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace d2b {

/// Cells of one building and their elevations.
struct BuildingCells {
    struct Run {
        std::int32_t row = 0;
        std::int32_t begin = 0;  ///< first column
        std::int32_t end = 0;
        [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
    };
    std::vector<Run> runs;           ///< runs in scan order; those of a row do not touch
    std::vector<double> elevations;  ///< by cell of the runs; NaN if not valid
};

}  // namespace d2b
