#include <cmath>
#include <limits>

#include <gdal_priv.h>

#include "samples.hpp"
#include "write_truth.hpp"

namespace d2b::sample {

namespace {

std::string tif(const std::string& folder, const std::string& name) {
    return folder + "/" + name + ".tif";
}

void write_example(const std::string& folder) {
    RasterSpec spec;
    spec.grid = {11, 7, 1, 1, {424800, 1, 0, 4513000, 0, -1}};
    spec.unit = {"ft", 0.3048, 1};
    spec.crs = "EPSG:26912";
    write_raster(tif(folder, "thesis_11x7"), spec,
                 [&](std::int32_t first_row, std::int32_t rows, std::span<float> elevations) {
                     std::size_t i = 0;
                     for (std::int32_t row = first_row; row < first_row + rows; ++row) {
                         for (std::int32_t col = 0; col < spec.grid.cols; ++col)
                             elevations[i++] = example_elevation(row, col);
                     }
                 });
}

void write_lakeside(const std::string& folder, const Sample& sample) {
    const Grid& grid = sample.raster.grid;
    const auto nodata = static_cast<float>(*sample.raster.nodata);
    write_raster(tif(folder, sample.name), sample.raster,
                 [&](std::int32_t first_row, std::int32_t rows, std::span<float> elevations) {
                     render(sample.scene, grid, sample.raster.unit, first_row, rows, elevations);
                     std::size_t i = 0;
                     for (std::int32_t row = first_row; row < first_row + rows; ++row) {
                         for (std::int32_t col = 0; col < grid.cols; ++col, ++i) {
                             if (on_lake(grid.centre(row, col)))
                                 elevations[i] = nodata;
                             else if (is_hole(row, col))
                                 elevations[i] = std::numeric_limits<float>::quiet_NaN();
                         }
                     }
                 });
}

void write_small_samples(const std::string& folder) {
    TruthWriter truth(folder + "/samples_truth.gpkg");
    for (const Sample& sample : {drawn_grid(), hotel(), courtyard(), degrees()}) {
        write_raster(tif(folder, sample.name), sample.raster, sample.scene);
        truth.add_buildings(sample.name, sample.raster, sample.scene.buildings);
    }
    const Sample lake = lakeside();
    write_lakeside(folder, lake);
    truth.add_buildings(lake.name, lake.raster, lake.scene.buildings);
    truth.finish();
}

}  // namespace

void make_samples(const std::string& folder) {
    GDALAllRegister();
    write_example(folder);
    write_small_samples(folder);
    const Sample sample = town();
    write_raster(tif(folder, sample.name), sample.raster, sample.scene);
    TruthWriter truth(folder + "/town_truth.gpkg");
    truth.add_buildings("buildings", sample.raster, sample.scene.buildings);
    truth.add_dissolved("blocks_dissolved", sample.raster, sample.scene.buildings);
    truth.finish();
    TruthWriter roofs(folder + "/town_roofs.gpkg");
    roofs.add_roofs("roofs", sample.raster, sample.scene.buildings);
    roofs.finish();
    TruthWriter parcels(folder + "/town_parcels.gpkg");
    parcels.add_parcels("parcels", sample.raster, sample.scene.parcels);
    parcels.finish();
}

}  // namespace d2b::sample
