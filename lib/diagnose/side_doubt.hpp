#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Whether what accompanies a DEM says anything where the DEM has a valid cell; true where it was not given.
struct SidesKnown {
    bool terrain = true;
    bool mask = true;
    bool ndvi = true;

    /// Of one part and of another.
    void merge(const SidesKnown& other) {
        terrain = terrain || other.terrain;
        mask = mask || other.mask;
        ndvi = ndvi || other.ndvi;
    }
};

/// Why a terrain or a mask leaves nothing to be found. Without a full stop; "" where they do not.
[[nodiscard]] std::string empty_side_doubt(const SidesKnown& known, const Options& options);
/// That an NDVI says nothing; "" where it does.
[[nodiscard]] std::string ndvi_doubt(const SidesKnown& known, const Options& options);

/// What of a DEM has no elevation of a terrain model that is given, where that is more than lies outside of
/// it, of which its source has warned, and not all.
struct TerrainGap {
    std::int64_t cells = 0;    ///< of the DEM that have an elevation
    std::int64_t known = 0;    ///< of these, where the terrain has one
    std::int64_t outside = 0;  ///< cells of the window that lie outside of the terrain model
    /// Cells of a building, or half of the window's border, because resampling a terrain loses cells there.
    std::int64_t fewest = 1;
};
/// That there is no ground there, with the share. "" where there is.
[[nodiscard]] std::string terrain_gap_doubt(const TerrainGap& gap, const std::string& dem,
                                            const std::string& terrain);

/// Whether there is one of these cells of the grids where the surface is known and the mask is not 0, or the
/// values are known. Looks no farther than the first.
[[nodiscard]] bool meets(const MetreGrid& surface, const Mask& mask, const Window& cells);
[[nodiscard]] bool meets(const MetreGrid& surface, const MetreGrid& values, const Window& cells);

}  // namespace d2b
