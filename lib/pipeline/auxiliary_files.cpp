#include "pipeline/auxiliary_files.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/version.hpp"
#include "elevations/filter_invalid.hpp"
#include "options/provenance_text.hpp"
#include "options/run_plan.hpp"
#include "read/correction_reader.hpp"
#include "read/footprint_reader.hpp"
#include "read/gdal_setup.hpp"
#include "read/parcel_reader.hpp"
#include "read/side_rasters.hpp"
#include "read/source_place.hpp"
#include "view/page/page_sink.hpp"
#include "write/raster/geotiff.hpp"
#include "write/surface/surface_sink.hpp"

namespace d2b::pipeline {

DemInfo with_given_crs(DemInfo dem, const Options& options) {
    if (!options.read.crs.empty())
        dem.crs_wkt = Crs(options.read.crs).wkt();
    return dem;
}

AuxiliarySinks open_scene_rasters(const Options& options, const DemInfo& dem,
                                  std::vector<std::string>& in_use) {
    const WriteOptions& write = options.write;
    const DemInfo grid = with_given_crs(dem, options);
    const auto open = [&](const std::string& destination, const char* what, bool elevations) {
        if (destination.empty())
            return std::unique_ptr<RasterSink>();
        writing::RasterMetadata meta;
        meta.description = what;
        meta.elevations = elevations;
        meta.metadata = {{"D2B_VERSION", std::string(version)},
                         {"D2B_SOURCE", utf8_text(source_text(grid.name, options.read))}};
        if (const std::string words = reproducing_arguments(options); !words.empty())
            meta.metadata.emplace("D2B_OPTIONS", utf8_text(words));
        auto sink = writing::open_geotiff_sink({destination, write.overwrite, in_use}, grid, meta);
        in_use.push_back(destination);
        return sink;
    };
    AuxiliarySinks sinks;
    sinks.ground = open(write.ground, "elevation of the ground", true);
    sinks.height = open(write.height, "height above the ground", false);
    sinks.canopy = open(write.canopy, "height of everything that is not a building", false);
    return sinks;
}

namespace {

std::string shape_text(std::int32_t rows, std::int32_t cols) {
    return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

/// @param option name of the option that gives the raster
reading::AuxiliaryRaster side_raster(const std::string& option, const std::string& name,
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
}  // namespace d2b::pipeline

namespace d2b {

AuxiliarySources open_auxiliary_sources(const Options& options, const DemInfo& dem,
                                        const Callbacks& callbacks, const AuxiliaryArrays& arrays) {
    reading::register_formats();
    const DemInfo grid = pipeline::with_given_crs(dem, options);
    AuxiliarySources sources;
    if (options.ground.mode == GroundMode::given) {
        const UnitReport units = resolve_units(grid, Crs(grid.crs_wkt), options.read.vertical_unit);
        sources.terrain = reading::open_terrain(
            pipeline::side_raster("ground", options.ground.terrain, arrays.terrain, grid), grid,
            units.vertical_metres, elevation_limits(options.read, units.vertical_metres), callbacks,
            {.keeps_undeclared = options.read.ignore_nodata});
    }
    if (!options.detect.mask.empty())
        sources.mask =
            reading::open_mask(pipeline::side_raster("mask", options.detect.mask, arrays.mask, grid),
                               options.detect.mask_layer, grid, callbacks);
    if (!options.detect.exclude.empty())
        sources.exclusion = reading::open_exclusion(
            {options.detect.exclude, options.detect.exclude_layer, options.detect.exclude_buffer}, grid,
            callbacks);
    if (!options.detect.corrections.empty())
        sources.corrections = reading::open_corrections(
            {options.detect.corrections, options.detect.corrections_layer}, grid, callbacks);
    if (!options.detect.ndvi.empty())
        sources.ndvi = reading::open_ndvi(
            pipeline::side_raster("ndvi", options.detect.ndvi, arrays.ndvi, grid), grid, callbacks);
    const DetectOptions& detect = options.detect;
    if (!detect.split_by.empty())
        sources.parcels =
            reading::open_parcels({detect.split_by, detect.split_layer, detect.split_field}, grid, callbacks);
    if (options.write.has_footprints()) {
        const std::string& target = options.outline.target_crs;
        sources.footprints =
            reading::open_footprints({options.write.footprints, options.write.footprints_layer,
                                      target.empty() ? "" : Crs(target).wkt()},
                                     grid, callbacks);
    }
    return sources;
}

AuxiliarySinks open_auxiliary_sinks(const Options& options, const DemInfo& dem) {
    const WriteOptions& write = options.write;
    std::vector<std::string> in_use = reading::rasters_of(options.read.source);
    in_use.insert(in_use.end(), {options.read.source, write.destination});
    for (const std::string& name : {options.ground.terrain, options.detect.mask, options.detect.exclude,
                                    options.detect.corrections, options.detect.ndvi, options.detect.split_by})
        if (!name.empty())
            in_use.push_back(name);
    AuxiliarySinks sinks = pipeline::open_scene_rasters(options, dem, in_use);
    for (const std::string& destination : write.surfaces) {
        writing::SurfaceDestination place = writing::resolve_surface_target(
            {destination, write.overwrite, in_use, writing::FileKind::surface});
        in_use.push_back(destination);
        if (place.materials)
            in_use.push_back(place.materials->name);
        sinks.surfaces.push_back(writing::open_surface_sink(std::move(place), write.surface_solids));
    }
    if (!write.page.empty()) {
        view::Page page = view::open_page(
            writing::resolve_file_target({write.page, write.overwrite, in_use, writing::FileKind::page}),
            {.dem = dem,
             .terrain = detects_buildings(options),
             .title = write.title,
             .credit = write.credit});
        sinks.surfaces.push_back(std::move(page.surface));
        sinks.page_relief = std::move(page.relief);
    }
    return sinks;
}

}  // namespace d2b
