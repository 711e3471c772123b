#include "pipeline/scene_raster_files.hpp"

#include "core/crs.hpp"
#include "core/utf8_text.hpp"
#include "dem2buildings/version.hpp"
#include "options/given_words.hpp"
#include "write/geotiff_sink.hpp"

namespace d2b {

DemInfo in_its_crs(DemInfo dem, const Options& options) {
    if (!options.read.crs.empty())
        dem.crs_wkt = Crs(options.read.crs).wkt();
    return dem;
}

SideSinks open_scene_rasters(const Options& options, const DemInfo& dem, const SceneRasterNames& names,
                             bool overwrite, std::vector<std::string>& in_use) {
    const DemInfo grid = in_its_crs(dem, options);
    const auto open = [&](const std::string& destination, const char* what, bool elevations) {
        if (destination.empty())
            return std::unique_ptr<RasterSink>();
        RasterMeta meta;
        meta.description = what;
        meta.elevations = elevations;
        meta.metadata = {{"D2B_VERSION", std::string(version)}, {"D2B_SOURCE", utf8_text(grid.name)}};
        if (const std::string words = given_words(options); !words.empty())
            meta.metadata.emplace("D2B_OPTIONS", utf8_text(words));
        auto sink = open_geotiff_sink({destination, overwrite, in_use}, grid, meta);
        in_use.push_back(destination);
        return sink;
    };
    SideSinks sinks;
    sinks.ground = open(names.ground, "elevation of the ground", true);
    sinks.height = open(names.height, "height above the ground", false);
    sinks.canopy = open(names.canopy, "height of everything that is no building", false);
    return sinks;
}

}  // namespace d2b
