#include "write_raster.hpp"

#include <algorithm>
#include <vector>

#include <cpl_string.h>

#include "gdal_guard.hpp"

namespace d2b::sample {

namespace {

constexpr std::int32_t rows_per_block = 256;

Dataset create(const std::string& path, const RasterSpec& spec) {
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    QuietGdal::require(driver != nullptr, path);
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("ZLEVEL", "9");
    options.SetNameValue("PREDICTOR", "3");
    if (spec.tiled)
        options.SetNameValue("TILED", "YES");
    Dataset dataset(
        driver->Create(path.c_str(), spec.grid.cols, spec.grid.rows, 1, GDT_Float32, options.List()));
    QuietGdal::require(dataset != nullptr, path);
    const OGRSpatialReference reference = spatial_reference(spec.crs, path);
    AffineTransform transform = spec.grid.transform;
    QuietGdal::require(dataset->SetSpatialRef(&reference) == CE_None &&
                           dataset->SetGeoTransform(transform.data()) == CE_None,
                       path);
    GDALRasterBand* const band = dataset->GetRasterBand(1);
    QuietGdal::require(band->SetUnitType(spec.unit.name.c_str()) == CE_None, path);
    if (spec.nodata)
        QuietGdal::require(band->SetNoDataValue(*spec.nodata) == CE_None, path);
    return dataset;
}

}  // namespace

void write_raster(const std::string& path, const RasterSpec& spec, const RowSource& source) {
    const QuietGdal quiet;
    Dataset dataset = create(path, spec);
    GDALRasterBand* const band = dataset->GetRasterBand(1);
    const std::int32_t cols = spec.grid.cols;
    std::vector<float> elevations;
    for (std::int32_t row = 0; row < spec.grid.rows; row += rows_per_block) {
        const std::int32_t rows = std::min(rows_per_block, spec.grid.rows - row);
        elevations.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
        source(row, rows, elevations);
        QuietGdal::require(band->RasterIO(GF_Write, 0, row, cols, rows, elevations.data(), cols, rows,
                                          GDT_Float32, 0, 0, nullptr) == CE_None,
                           path);
    }
    close(std::move(dataset), path);
}

void write_raster(const std::string& path, const RasterSpec& spec, const Scene& scene) {
    write_raster(path, spec, [&](std::int32_t first_row, std::int32_t rows, std::span<float> elevations) {
        render(scene, spec.grid, spec.unit, first_row, rows, elevations);
    });
}

}  // namespace d2b::sample
