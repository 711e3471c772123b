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
/// @param min_area_m2 minimum area of a building
/// @param max_width_m maximum width of a building
void add_islands(const MetreGrid& surface, const CellSize& cell, const Window& own, double min_area_m2,
                 double max_width_m, ValidIslands& islands, Executor& threads);

/// Returns a warning if there is no ground for an estimate. A clause without a full stop; "" if there may be.
[[nodiscard]] std::string missing_ground_warning(const ValidIslands& islands, GroundMode mode,
                                                 const std::string& dem);

/// Flags of auxiliary rasters with at least one value at a valid cell of the DEM; true if a raster was not
/// given.
struct AuxiliaryCoverage {
    bool terrain = true;
    bool mask = true;
    bool ndvi = true;

    /// Merges the flags of two parts.
    void merge(const AuxiliaryCoverage& other) {
        terrain = terrain || other.terrain;
        mask = mask || other.mask;
        ndvi = ndvi || other.ndvi;
    }
};

/// Returns the reason why a terrain or a mask prevents any detection. A clause without a full stop; "" if
/// they do not.
[[nodiscard]] std::string empty_auxiliary_warning(const AuxiliaryCoverage& known, const Options& options);
/// Returns a warning if an NDVI has no values; "" if it has.
[[nodiscard]] std::string ndvi_warning(const AuxiliaryCoverage& known, const Options& options);

/// Cells of a DEM without elevation in the given terrain model, if they exceed the part outside of the model
/// (its source has warned of that), and are not all.
struct TerrainGap {
    std::int64_t cells = 0;    ///< valid cells of the DEM
    std::int64_t known = 0;    ///< number of these with an elevation in the terrain model
    std::int64_t outside = 0;  ///< cells of the window outside of the terrain model
    /// Threshold: the cells of a building, or half of the window's border, because resampling a terrain loses
    /// cells there.
    std::int64_t fewest = 1;
};
/// Returns a warning with the share of cells without ground; "" if there are too few.
[[nodiscard]] std::string terrain_gap_warning(const TerrainGap& gap, const std::string& dem,
                                              const std::string& terrain);

/// True if the part of the grids has a cell with a valid surface and a mask other than 0, or a valid value.
/// Stops at the first.
[[nodiscard]] bool has_value_on_surface(const MetreGrid& surface, const Mask& mask, const Window& cells);
[[nodiscard]] bool has_value_on_surface(const MetreGrid& surface, const MetreGrid& values,
                                        const Window& cells);

}  // namespace d2b
