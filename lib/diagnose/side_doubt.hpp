#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Flags of auxiliary rasters with at least one value at a valid cell of the DEM; true if a raster was not
/// given.
struct SidesKnown {
    bool terrain = true;
    bool mask = true;
    bool ndvi = true;

    /// Merges the flags of two parts.
    void merge(const SidesKnown& other) {
        terrain = terrain || other.terrain;
        mask = mask || other.mask;
        ndvi = ndvi || other.ndvi;
    }
};

/// Returns the reason why a terrain or a mask prevents any detection. A clause without a full stop; "" if
/// they do not.
[[nodiscard]] std::string empty_side_doubt(const SidesKnown& known, const Options& options);
/// Returns a warning if an NDVI has no values; "" if it has.
[[nodiscard]] std::string ndvi_doubt(const SidesKnown& known, const Options& options);

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
[[nodiscard]] std::string terrain_gap_doubt(const TerrainGap& gap, const std::string& dem,
                                            const std::string& terrain);

/// True if the part of the grids has a cell with a valid surface and a mask other than 0, or a valid value.
/// Stops at the first.
[[nodiscard]] bool meets(const MetreGrid& surface, const Mask& mask, const Window& cells);
[[nodiscard]] bool meets(const MetreGrid& surface, const MetreGrid& values, const Window& cells);

}  // namespace d2b
