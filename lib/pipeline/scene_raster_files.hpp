#pragma once

#include <string>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Names of the rasters that a search writes; "" for those that it does not.
struct SceneRasterNames {
    std::string ground;
    std::string height;
    std::string canopy;
};

/// The grid in the CRS that -a_srs gives.
[[nodiscard]] DemInfo in_its_crs(DemInfo dem, const Options& options);

/// GeoTIFFs, which appear whole or not at all. @param dem whose window they get
/// @param in_use names of what else is read and written, to which theirs are added
/// @throws OptionError, OutputError
[[nodiscard]] SideSinks open_scene_rasters(const Options& options, const DemInfo& dem,
                                           const SceneRasterNames& names, bool overwrite,
                                           std::vector<std::string>& in_use);

}  // namespace d2b
