#pragma once

#include <string>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::pipeline {

/// File names of the rasters that a search writes; "" for those not asked for.
struct SceneRasterNames {
    std::string ground;
    std::string height;
    std::string canopy;
};

/// Returns the grid with the CRS overridden by -a_srs.
[[nodiscard]] DemInfo with_given_crs(DemInfo dem, const Options& options);

/// Opens GeoTIFFs that are published complete or not at all. @param dem its window is the rasters' extent
/// @param in_use names of all other inputs and outputs; the new names are appended
/// @throws OptionError, OutputError
[[nodiscard]] AuxiliarySinks open_scene_rasters(const Options& options, const DemInfo& dem,
                                                const SceneRasterNames& names, bool overwrite,
                                                std::vector<std::string>& in_use);

}  // namespace d2b::pipeline
