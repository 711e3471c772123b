#include "read/side_rasters.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/units.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/open_sources.hpp"
#include "elevations/sift_rules.hpp"
#include "options/run_plan.hpp"
#include "pipeline/scene_raster_files.hpp"
#include "read/parcel_reader.hpp"
#include "read/start_gdal.hpp"
#include "write/page_sink.hpp"
#include "write/surface_sinks.hpp"

namespace d2b {

SideSources open_side_sources(const Options& options, const DemInfo& dem, const Callbacks& callbacks) {
    register_formats();
    const DemInfo grid = in_its_crs(dem, options);
    SideSources sources;
    if (options.ground.mode == GroundMode::given) {
        const UnitReport units = resolve_units(grid, Crs(grid.crs_wkt), options.read.vertical_unit);
        sources.terrain = open_terrain(options.ground.terrain, grid, units.vertical_metres,
                                       elevation_limits(options.read, units.vertical_metres), callbacks,
                                       {.keeps_undeclared = options.read.ignore_nodata});
    }
    if (!options.detect.mask.empty())
        sources.mask = open_mask(options.detect.mask, options.detect.mask_layer, grid, callbacks);
    if (!options.detect.ndvi.empty())
        sources.ndvi = open_ndvi(options.detect.ndvi, grid, callbacks);
    const DetectOptions& detect = options.detect;
    if (!detect.split_by.empty())
        sources.parcels =
            open_parcels({detect.split_by, detect.split_layer, detect.split_field}, grid, callbacks);
    return sources;
}

SideSinks open_side_sinks(const Options& options, const DemInfo& dem) {
    const WriteOptions& write = options.write;
    std::vector<std::string> in_use{options.read.source, write.destination};
    for (const std::string& name :
         {options.ground.terrain, options.detect.mask, options.detect.ndvi, options.detect.split_by})
        if (!name.empty())
            in_use.push_back(name);
    SideSinks sinks =
        open_scene_rasters(options, dem, {write.ground, write.height, write.canopy}, write.overwrite, in_use);
    for (const std::string& destination : write.surfaces) {
        SurfacePlace place = locate_surface({destination, write.overwrite, in_use, RasterFormat::surface});
        in_use.push_back(destination);
        if (place.materials)
            in_use.push_back(place.materials->name);
        sinks.surfaces.push_back(open_surface_sink(std::move(place), write.surface_solids));
    }
    if (!write.page.empty()) {
        Page page = open_page(locate_raster({write.page, write.overwrite, in_use, RasterFormat::page}),
                              {.dem = dem, .terrain = detects_buildings(options)});
        sinks.surfaces.push_back(std::move(page.surface));
        sinks.page_relief = std::move(page.relief);
    }
    return sinks;
}

}  // namespace d2b
