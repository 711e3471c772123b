#pragma once

#include <memory>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/raster_sink.hpp"

namespace d2b {

/// What the options name beside the DEM; empty where they name nothing.
struct SideSources {
    std::unique_ptr<DemSource> terrain;
    std::unique_ptr<DemSource> mask;
    std::unique_ptr<DemSource> ndvi;
};

/// What the options name beside the destination; empty where they name nothing.
struct SideSinks {
    std::unique_ptr<RasterSink> ground;
    std::unique_ptr<RasterSink> height;
    std::unique_ptr<RasterSink> canopy;
};

/// A terrain model, a mask and an NDVI, on the grid of the DEM. @throws InputError
[[nodiscard]] SideSources open_side_sources(const Options& options, const DemInfo& dem,
                                            const Callbacks& callbacks = {});
/// GeoTIFFs, which appear whole or not at all. @throws OptionError, OutputError
[[nodiscard]] SideSinks open_side_sinks(const Options& options, const DemInfo& dem);

}  // namespace d2b
