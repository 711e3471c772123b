#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// First cell of a region in scan order.
struct FirstCell {
    std::int32_t row = 0;
    std::int32_t col = 0;

    friend bool operator==(const FirstCell&, const FirstCell&) = default;
};

/// Crown that was cut off a roof.
struct CutCrown {
    FirstCell first;
    std::int64_t cells = 0;
};

/// Objects rejected before classification, identified by their first cells, so that objects seen by several
/// overlapping units are counted once.
struct LeftOut {
    std::vector<FirstCell> small;  ///< objects with fewer cells than a building needs
    std::vector<FirstCell> low;    ///< see low_roofs()
    std::vector<CutCrown> crowns;  ///< see take_crowns_off(); independent of options
    std::vector<FirstCell>
        parts;  ///< parts cut off by parcels that are too small or too narrow for buildings
};

/// Removes small regions and renumbers the others from 1.
/// @return first cells of the removed regions
[[nodiscard]] std::vector<FirstCell> take_small_out(Regions& regions, std::int64_t least_cells);

/// Finds potential roofs that are too low: smooth segments of the surface with the size of a building that
/// rise more than a metre above the ground, but nowhere by more than `min_height`.
/// @param flags result of smoothness()
/// @return their first cells
[[nodiscard]] std::vector<FirstCell> low_roofs(const Scene& scene, const Grid<std::uint8_t>& flags,
                                               double min_height, std::int64_t least_cells,
                                               Executor& threads);

}  // namespace d2b
