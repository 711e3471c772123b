#pragma once

#include <string>

#include "core/row_bands.hpp"
#include "dem2buildings/options.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Whether what accompanies a DEM says anything where the DEM has a valid cell; true where it was not given.
struct SidesKnown {
    bool terrain = true;
    bool mask = true;
    bool ndvi = true;
};

/// Why a terrain or a mask leaves nothing to be found. Without a full stop; "" where they do not.
[[nodiscard]] std::string empty_side_doubt(const SidesKnown& known, const Options& options);
/// That an NDVI says nothing; "" where it does.
[[nodiscard]] std::string ndvi_doubt(const SidesKnown& known, const Options& options);

/// Whether there is a cell in these rows where the surface is known and the mask is not 0, or the values are
/// known. Looks no farther than the first.
[[nodiscard]] bool meets(const MetreGrid& surface, const Mask& mask, RowBand rows);
[[nodiscard]] bool meets(const MetreGrid& surface, const MetreGrid& values, RowBand rows);

}  // namespace d2b
