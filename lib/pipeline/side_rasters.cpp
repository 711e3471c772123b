#include "read/side_rasters.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/units.hpp"
#include "dem2buildings/error.hpp"
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
namespace {

std::string shape_text(std::int32_t rows, std::int32_t cols) {
    return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

/// @param option name of the option that gives the raster
SideRaster side_raster(const std::string& option, const std::string& name,
                       const std::optional<ElevationArray>& array, const DemInfo& dem) {
    if (!array)
        return {name};
    if (array->rows != dem.rows || array->cols != dem.cols)
        throw OptionError("-" + option + " has the shape " + shape_text(array->rows, array->cols) + " and '" +
                          dem.name + "' the shape " + shape_text(dem.rows, dem.cols) +
                          "; give an array with one value per cell of the DEM.");
    return {name, &*array};
}

}  // namespace

SideSources open_side_sources(const Options& options, const DemInfo& dem, const Callbacks& callbacks,
                              const SideArrays& arrays) {
    register_formats();
    const DemInfo grid = in_its_crs(dem, options);
    SideSources sources;
    if (options.ground.mode == GroundMode::given) {
        const UnitReport units = resolve_units(grid, Crs(grid.crs_wkt), options.read.vertical_unit);
        sources.terrain =
            open_terrain(side_raster("ground", options.ground.terrain, arrays.terrain, grid), grid,
                         units.vertical_metres, elevation_limits(options.read, units.vertical_metres),
                         callbacks, {.keeps_undeclared = options.read.ignore_nodata});
    }
    if (!options.detect.mask.empty())
        sources.mask = open_mask(side_raster("mask", options.detect.mask, arrays.mask, grid),
                                 options.detect.mask_layer, grid, callbacks);
    if (!options.detect.ndvi.empty())
        sources.ndvi =
            open_ndvi(side_raster("ndvi", options.detect.ndvi, arrays.ndvi, grid), grid, callbacks);
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
