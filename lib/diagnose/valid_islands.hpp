#pragma once

#include <cstdint>
#include <string>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Whether what has elevations lies in pieces as wide as buildings with NoData around each, as in a raster
/// of buildings whose ground is NoData. Whole numbers: they add up whatever their order.
struct ValidIslands {
    std::int64_t cells = 0;    ///< that have an elevation
    std::int64_t narrow = 0;   ///< of these, in pieces large enough for a building and not too wide for one
    std::int64_t islands = 0;  ///< such pieces
    std::int64_t largest = 0;  ///< cells of the largest of these

    void merge(const ValidIslands& other);
    /// Most of what has elevations is in narrow pieces.
    [[nodiscard]] bool narrow_most() const { return 2 * narrow > cells; }
};

/// Adds the pieces of a unit's own cells. Where next to all of these have an elevation only they are counted.
/// @param known of the own cells, how many have an elevation @param smallest_m2 of a building
/// @param widest_m of a building
void add_islands(const MetreGrid& surface, const CellSize& cell, const Window& own, double smallest_m2,
                 double widest_m, ValidIslands& islands, Executor& threads);

/// That an estimated ground has no ground to be estimated from. Without a full stop; "" where it may have.
[[nodiscard]] std::string missing_ground_doubt(const ValidIslands& islands, GroundMode mode,
                                               const std::string& dem);

}  // namespace d2b
