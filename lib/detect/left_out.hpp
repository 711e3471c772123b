#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// What options left out before it was judged: each object by the row of its first cell, so that of what
/// overlapping strips see each counts it once.
struct LeftOut {
    std::vector<std::int32_t> small;  ///< objects with fewer cells than a building needs
    std::vector<std::int32_t> low;    ///< see low_roofs()
};

/// Takes regions with fewer cells out of others. @return the rows of their first cells
[[nodiscard]] std::vector<std::int32_t> take_small_out(Regions& regions, std::int64_t least_cells);

/// What would have been part of a building if it stood higher: smooth pieces of the surface, as large as a
/// building, that rise above the ground by more than a metre but nowhere by more than `min_height`.
/// @param flags of smoothness() @return the rows of their first cells
[[nodiscard]] std::vector<std::int32_t> low_roofs(const Scene& scene, const Grid<std::uint8_t>& flags,
                                                  double min_height, std::int64_t least_cells,
                                                  Executor& threads);

}  // namespace d2b
