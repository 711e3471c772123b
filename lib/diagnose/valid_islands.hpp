#pragma once

#include <cstdint>
#include <string>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Counts valid cells in islands surrounded by NoData and as wide as buildings, as in a raster of buildings
/// with NoData as ground. Integer counts, so the order does not matter.
struct ValidIslands {
    std::int64_t cells = 0;  ///< valid cells
    std::int64_t narrow =
        0;  ///< number of these in pieces large enough for a building and not too wide for one
    std::int64_t islands = 0;  ///< number of such pieces
    std::int64_t largest = 0;  ///< cells of the largest one

    void merge(const ValidIslands& other);
    /// True if most valid cells are in narrow pieces.
    [[nodiscard]] bool narrow_most() const { return 2 * narrow > cells; }
};

/// Adds the pieces of a unit's core. If nearly all of its cells are valid, only their number is added.
/// @param known number of valid cells in the core
/// @param smallest_m2 minimum area of a building
/// @param widest_m maximum width of a building
void add_islands(const MetreGrid& surface, const CellSize& cell, const Window& own, double smallest_m2,
                 double widest_m, ValidIslands& islands, Executor& threads);

/// Returns a warning if there is no ground for an estimate. A clause without a full stop; "" if there may be.
[[nodiscard]] std::string missing_ground_doubt(const ValidIslands& islands, GroundMode mode,
                                               const std::string& dem);

}  // namespace d2b
