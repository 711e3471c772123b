#include "write/geotiff_file.hpp"

#include <utility>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

namespace {

CrsOwner srs_for(const std::string& wkt, bool elevations) {
    CrsOwner srs(OSRNewSpatialReference(wkt.c_str()));
    if (!srs)
        return srs;
    OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const auto unit = elevations ? Crs(wkt).vertical_unit() : std::nullopt;
    if (unit && unit->metres == 1)
        return srs;
    if (OSRIsCompound(srs.get()) != FALSE)
        OSRStripVertical(srs.get());
    OSRDemoteTo2D(srs.get(), nullptr);
    return srs;
}

AffineTransform transform_of(const DemInfo& grid) {
    AffineTransform g = grid.transform;
    g[0] += grid.window.col * g[1] + grid.window.row * g[2];
    g[3] += grid.window.col * g[4] + grid.window.row * g[5];
    return g;
}

}  // namespace

GeoTiffFile::GeoTiffFile(const WriteTarget& target, const std::string& path, const DemInfo& grid,
                         const RasterMeta& meta)
    : target_(target) {
    NameValueList options;
    options.set("TILED", "YES");
    options.set("BLOCKXSIZE", std::to_string(tile));
    options.set("BLOCKYSIZE", std::to_string(tile));
    options.set("COMPRESS", "DEFLATE");
    options.set("PREDICTOR", "3");
    options.set("BIGTIFF", "IF_SAFER");
    OgrCall call(target_);
    dataset_.reset(GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), grid.window.cols, grid.window.rows,
                              1, GDT_Float32, options.get()));
    call.check(dataset_ != nullptr, "creating the GeoTIFF");
    place(grid, meta);
    describe(meta);
}

void GeoTiffFile::place(const DemInfo& grid, const RasterMeta& meta) {
    OgrCall call(target_);
    AffineTransform transform = transform_of(grid);
    bool done = !grid.georeferenced || GDALSetGeoTransform(dataset_.get(), transform.data()) == CE_None;
    call.check(done, "placing it");
    if (grid.crs_wkt.empty())
        return;
    const CrsOwner srs = srs_for(grid.crs_wkt, meta.elevations);
    done = srs != nullptr && GDALSetSpatialRef(dataset_.get(), srs.get()) == CE_None;
    call.check(done, "setting the CRS");
}

void GeoTiffFile::describe(const RasterMeta& meta) {
    OgrCall call(target_);
    const GDALRasterBandH band = GDALGetRasterBand(dataset_.get(), 1);
    bool done = GDALSetRasterNoDataValue(band, static_cast<double>(nodata)) == CE_None &&
                GDALSetRasterUnitType(band, meta.unit.c_str()) == CE_None;
    GDALSetDescription(band, meta.description.c_str());
    for (const auto& [name, value] : meta.metadata)
        done = GDALSetMetadataItem(dataset_.get(), name.c_str(), value.c_str(), nullptr) == CE_None && done;
    call.check(done, "describing it");
}

void GeoTiffFile::write(const Window& cells, std::span<float> values) {
    OgrCall call(target_);
    const GDALRasterBandH band = GDALGetRasterBand(dataset_.get(), 1);
    const bool written = GDALRasterIO(band, GF_Write, cells.col, cells.row, cells.cols, cells.rows,
                                      values.data(), cells.cols, cells.rows, GDT_Float32, 0, 0) == CE_None;
    // Flush now, because otherwise GDAL flushes when it needs memory for another file, whose reader would get
    // the error of a full disk.
    const bool flushed = written && GDALFlushRasterCache(band) == CE_None;
    call.check(flushed, "writing cells");
}

void GeoTiffFile::close() {
    close_written(target_, std::move(dataset_));
}

}  // namespace d2b
