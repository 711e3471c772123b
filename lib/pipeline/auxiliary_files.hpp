#pragma once

#include <string>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::pipeline {

/// Returns the grid with the CRS overridden by -a_srs.
[[nodiscard]] DemInfo with_given_crs(DemInfo dem, const Options& options);

/// Opens the rasters of a search as GeoTIFFs that are published complete or not at all.
/// @param dem its window is the rasters' extent
/// @param in_use names of all other inputs and outputs; the new names are appended
/// @throws OptionError, OutputError
[[nodiscard]] AuxiliarySinks open_scene_rasters(const Options& options, const DemInfo& dem,
                                                std::vector<std::string>& in_use);

}  // namespace d2b::pipeline
