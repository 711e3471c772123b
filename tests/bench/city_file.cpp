#include "city_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <cpl_string.h>

#include "gdal_guard.hpp"

namespace d2b::bench {

namespace {

using sample::Dataset;
using sample::QuietGdal;

constexpr std::int32_t tile = 256;
constexpr GIntBig cache = 64 << 20;  // bytes: two rows of tiles of the largest city

Dataset create(const std::string& path, const City& city, int threads) {
    GDALAllRegister();
    GDALSetCacheMax64(cache);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    QuietGdal::require(driver != nullptr, path);
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", "3");
    options.SetNameValue("ZLEVEL", "2");
    options.SetNameValue("TILED", "YES");
    options.SetNameValue("BIGTIFF", "IF_SAFER");
    options.SetNameValue("NUM_THREADS", std::to_string(threads).c_str());
    const sample::Grid& grid = city.grid();
    Dataset dataset(driver->Create(path.c_str(), grid.cols, grid.rows, 1, GDT_Float32, options.List()));
    QuietGdal::require(dataset != nullptr, path);
    const OGRSpatialReference reference = sample::spatial_reference("EPSG:25833", path);
    AffineTransform transform = grid.transform;
    QuietGdal::require(dataset->SetSpatialRef(&reference) == CE_None &&
                           dataset->SetGeoTransform(transform.data()) == CE_None &&
                           dataset->GetRasterBand(1)->SetNoDataValue(City::nodata) == CE_None,
                       path);
    return dataset;
}

}  // namespace

void write_city(const std::string& path, const CitySpec& spec, int threads) {
    const QuietGdal quiet;
    City city(spec, threads);
    Dataset dataset = create(path, city, threads);
    std::vector<float> elevations;
    for (std::int32_t row = 0; row < spec.side; row += tile) {
        const std::int32_t rows = std::min(tile, spec.side - row);
        elevations.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(spec.side));
        city.render(row, rows, elevations);
        QuietGdal::require(
            dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, row, spec.side, rows, elevations.data(),
                                                spec.side, rows, GDT_Float32, 0, 0, nullptr) == CE_None,
            path);
    }
    sample::close(std::move(dataset), path);
}

}  // namespace d2b::bench
