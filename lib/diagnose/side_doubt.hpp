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

/// Whether there is one of these cells of the grids where the surface is known and the mask is not 0, or the
/// values are known. Looks no farther than the first.
[[nodiscard]] bool meets(const MetreGrid& surface, const Mask& mask, const Window& cells);
[[nodiscard]] bool meets(const MetreGrid& surface, const MetreGrid& values, const Window& cells);

}  // namespace d2b
