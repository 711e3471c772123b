#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// The first cell of a region in scan order.
struct FirstCell {
    std::int32_t row = 0;
    std::int32_t col = 0;

    friend bool operator==(const FirstCell&, const FirstCell&) = default;
};

/// A crown that leaned on a roof.
struct CutCrown {
    FirstCell first;
    std::int64_t cells = 0;
};

/// What options left out before it was judged: each object by its first cell, so that of what overlapping
/// units see each is counted once.
struct LeftOut {
    std::vector<FirstCell> small;  ///< objects with fewer cells than a building needs
    std::vector<FirstCell> low;    ///< see low_roofs()
    std::vector<CutCrown> crowns;  ///< see take_crowns_off(): no option's, but left out as well
    std::vector<FirstCell> parts;  ///< that parcels cut off, but too small or too narrow to be buildings
};

/// Takes regions with fewer cells out of others, which are numbered from 1 again. @return their first cells
[[nodiscard]] std::vector<FirstCell> take_small_out(Regions& regions, std::int64_t least_cells);

/// What would have been part of a building if it stood higher: smooth pieces of the surface, as large as a
/// building, that rise above the ground by more than a metre but nowhere by more than `min_height`.
/// @param flags of smoothness() @return their first cells
[[nodiscard]] std::vector<FirstCell> low_roofs(const Scene& scene, const Grid<std::uint8_t>& flags,
                                               double min_height, std::int64_t least_cells,
                                               Executor& threads);

}  // namespace d2b
