#include "write/raster/geotiff.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <cpl_string.h>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"
#include "write/io_error_monitor.hpp"
#include "write/ogr_util.hpp"
#include "write/staged_file.hpp"
#include "write/staging.hpp"
#include "write/vector/vector_format.hpp"
#include "write/xml_text.hpp"

namespace d2b::writing {

/// Writes a GeoTIFF of 32-bit floats on the window of a DEM: tiles of 256 x 256, DEFLATE with the
/// floating-point predictor, BigTIFF if it might exceed 4 GB. NoData is -9999, because other programs expect
/// it.
class GeoTiffFile {
  public:
    static constexpr std::int32_t tile = 256;
    static constexpr float nodata = -9999;

    /// @param path file to write @throws OutputError
    GeoTiffFile(WriteTarget target, const std::string& path, const DemInfo& grid, const RasterMetadata& meta);

    /// @param cells window of one tile, relative to the first row and column @param values row by row
    /// @throws OutputError
    void write(const Window& cells, std::span<float> values);
    /// @throws OutputError, also if only closing fails
    void close();

  private:
    void set_georeferencing(const DemInfo& grid, const RasterMetadata& meta);
    void describe(const RasterMetadata& meta);

    WriteTarget target_;
    std::optional<IoErrorMonitor> monitor_;  ///< of a local file; declared before its dataset, which uses it
    reading::DatasetOwner dataset_;
};

namespace {

reading::CrsOwner raster_srs(const std::string& wkt, bool elevations) {
    reading::CrsOwner srs(OSRNewSpatialReference(wkt.c_str()));
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

/// Buffers cells until their tile is complete, because a tile that is compressed twice leaves a gap in the
/// file.
class GeoTiffSink final : public FileSink<RasterSink> {
  public:
    GeoTiffSink(FileDestination place, DemInfo grid, RasterMetadata meta)
        : staged_(std::move(place)), grid_(std::move(grid)), meta_(std::move(meta)) {
        for (std::int32_t row = 0; row < grid_.window.rows; row += GeoTiffFile::tile)
            for (std::int32_t col = 0; col < grid_.window.cols; col += GeoTiffFile::tile)
                missing_.push_back(tile_at({row, col, 1, 1}).points());
    }
    ~GeoTiffSink() override;

    void write(const Window& part, std::span<const float> values) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return staged_.take_warnings(); }

  private:
    // Rows and columns are relative to the first ones of the window.
    [[nodiscard]] Window tile_at(const Window& cell) const;
    [[nodiscard]] std::size_t tile_index(const Window& tile) const;
    /// Copies the cells of a part that lie in a tile. @param values cells of the part
    void copy_cells(const Window& tile, const Window& part, std::span<const float> values);
    void begin();

    StagedFile staged_;
    DemInfo grid_;
    RasterMetadata meta_;
    std::optional<GeoTiffFile>
        file_;  ///< declared after the staged raster, because it must be closed before its folder is removed
    std::vector<std::int64_t> missing_;                ///< missing cells per tile, row-major
    std::map<std::size_t, std::vector<float>> tiles_;  ///< incomplete tiles
};

GeoTiffSink::~GeoTiffSink() {
    const reading::GdalMessages quiet;
    file_.reset();
}

Window GeoTiffSink::tile_at(const Window& cell) const {
    constexpr std::int32_t side = GeoTiffFile::tile;
    const Window tile{cell.row / side * side, cell.col / side * side, side, side};
    return {tile.row, tile.col, std::min(side, grid_.window.rows - tile.row),
            std::min(side, grid_.window.cols - tile.col)};
}

std::size_t GeoTiffSink::tile_index(const Window& tile) const {
    constexpr std::int32_t side = GeoTiffFile::tile;
    const std::int64_t across = (std::int64_t{grid_.window.cols} + side - 1) / side;
    return static_cast<std::size_t>(tile.row / side * across + tile.col / side);
}

void GeoTiffSink::begin() {
    const reading::NoSidecar no_sidecar;
    file_.emplace(staged_.target(), staged_.begin(), grid_, meta_);
}

void GeoTiffSink::write(const Window& part, std::span<const float> values) {
    const Window& window = grid_.window;
    const Window here{part.row - window.row, part.col - window.col, part.rows, part.cols};
    const bool inside = here.row >= 0 && here.col >= 0 && here.rows >= 0 && here.cols >= 0 &&
                        here.rows <= window.rows - here.row && here.cols <= window.cols - here.col;
    if (!inside || values.size() != static_cast<std::size_t>(here.points()))
        throw OutputError("Cannot write \"" + staged_.name() + "\": " + std::to_string(values.size()) +
                          " values were given for " + std::to_string(part.rows) + " rows from " +
                          std::to_string(part.row) + " on and " + std::to_string(part.cols) +
                          " columns from " + std::to_string(part.col) + " on, which are not part of it.");
    Window tile;
    for (std::int32_t row = here.row; row < here.end_row(); row = tile.end_row())
        for (std::int32_t col = here.col; col < here.end_col(); col = tile.end_col()) {
            tile = tile_at({row, col, 1, 1});
            copy_cells(tile, here, values);
        }
}

void GeoTiffSink::copy_cells(const Window& tile, const Window& part, std::span<const float> values) {
    const std::int32_t row = std::max(tile.row, part.row);
    const std::int32_t col = std::max(tile.col, part.col);
    const Window both{row, col, std::min(tile.end_row(), part.end_row()) - row,
                      std::min(tile.end_col(), part.end_col()) - col};
    const std::size_t number = tile_index(tile);
    if (both.points() > missing_[number])
        throw OutputError("Cannot write \"" + staged_.name() + "\": some of its cells were given twice.");
    std::vector<float>& cells = tiles_[number];
    cells.resize(static_cast<std::size_t>(tile.points()));
    for (std::int32_t r = both.row; r < both.end_row(); ++r) {
        const auto from = values.begin() + std::ptrdiff_t{r - part.row} * part.cols + (col - part.col);
        std::transform(from, from + both.cols,
                       cells.begin() + std::ptrdiff_t{r - tile.row} * tile.cols + (col - tile.col),
                       [](float value) { return std::isfinite(value) ? value : GeoTiffFile::nodata; });
    }
    missing_[number] -= both.points();
    if (missing_[number] > 0)
        return;
    if (!file_)
        begin();
    file_->write(tile, cells);
    tiles_.erase(number);
}

void GeoTiffSink::prepare(CommitList& commit) {
    const std::int64_t missing = std::accumulate(missing_.begin(), missing_.end(), std::int64_t{0});
    if (missing > 0)
        throw OutputError("Cannot write \"" + staged_.name() + "\": " + std::to_string(missing) + " of its " +
                          std::to_string(grid_.window.points()) + " cells were not given.");
    const reading::NoSidecar no_sidecar;
    file_->close();
    staged_.prepare(commit);
}

/// Tests with a raster of one cell that GeoTIFF can hold the CRS. GDAL drops a CRS without GeoTIFF keys or
/// writes it to a sidecar file, which would outlive a failed run.
void require_crs_kept(const std::string& name, DemInfo grid, const RasterMetadata& meta) {
    if (grid.crs_wkt.empty())
        return;
    grid.window.rows = grid.window.cols = 1;
    const reading::GdalMessages quiet;
    const reading::NoSidecar no_sidecar;
    const VsimemFolder memory;
    const std::string file = memory.file("crs.tif");
    const WriteTarget target{.name = name, .hidden_folder = ""};
    GeoTiffFile(target, file, grid, meta).close();
    const reading::DatasetOwner dataset(GDALOpen(file.c_str(), GA_ReadOnly));
    if (!dataset || GDALGetSpatialRef(dataset.get()) == nullptr)
        throw OutputError(
            "Cannot write \"" + name + "\": GeoTIFF cannot hold the coordinate reference system '" +
            Crs(grid.crs_wkt).name() + "' of the DEM; convert it to another one with gdalwarp first.");
}

std::string optional_element(const std::string& name, const std::string& text) {
    return text.empty() ? "" : xml_element(2, name, text);
}

std::string crs_text(GDALDatasetH dataset) {
    OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset);
    char* wkt = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT2_2018", nullptr};
    if (crs == nullptr || OSRExportToWktEx(crs, &wkt, options.data()) != OGRERR_NONE)
        return "";
    std::string axes;
    int count = 0;
    const int* const mapping = OSRGetDataAxisToSRSAxisMapping(crs, &count);
    for (int i = 0; i < count; ++i)
        axes += (i == 0 ? "" : ",") + std::to_string(mapping[i]);
    std::string text = "  <SRS dataAxisToSRSAxisMapping=\"" + axes + "\">" + xml_text(wkt) + "</SRS>\n";
    CPLFree(wkt);
    return text;
}

std::string metadata_text(GDALDatasetH dataset) {
    std::string items;
    const CPLStringList metadata(CSLDuplicate(GDALGetMetadata(dataset, nullptr)));
    for (int i = 0; i < metadata.size(); ++i) {
        char* key = nullptr;
        const char* const value = CPLParseNameValue(metadata[i], &key);
        if (key != nullptr && value != nullptr)
            items += "    <MDI key=\"" + xml_text(key) + "\">" + xml_text(value) + "</MDI>\n";
        CPLFree(key);
    }
    return items.empty() ? "" : "  <Metadata>\n" + items + "  </Metadata>\n";
}

/// Returns the VRT up to its first source.
std::string vrt_header(const std::string& first, std::int32_t rows, std::int32_t cols) {
    reading::register_formats();
    const reading::GdalMessages messages(first, first);
    const reading::DatasetOwner dataset(GDALOpenEx(first.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
    if (!dataset)
        throw InputError("'" + first + "' cannot be read: " + messages.reason_for(first) +
                         "; delete it and run 'find' of tile 0 again.");
    std::string text = "<VRTDataset rasterXSize=\"" + std::to_string(cols) + "\" rasterYSize=\"" +
                       std::to_string(rows) + "\">\n" + crs_text(dataset.get());
    if (std::array<double, 6> place{}; GDALGetGeoTransform(dataset.get(), place.data()) == CE_None)
        text += optional_element("GeoTransform", numbers_text(place, ", "));
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    return text + metadata_text(dataset.get()) + "  <VRTRasterBand dataType=\"Float32\" band=\"1\">\n" +
           optional_element("Description", GDALGetDescription(band)) +
           optional_element("NoDataValue", number_text(static_cast<double>(GeoTiffFile::nodata))) +
           optional_element("UnitType", GDALGetRasterUnitType(band));
}

std::string vrt_rect(const char* name, std::int32_t row, std::int32_t col, const Window& size) {
    return std::string("<") + name + " xOff=\"" + std::to_string(col) + "\" yOff=\"" + std::to_string(row) +
           "\" xSize=\"" + std::to_string(size.cols) + "\" ySize=\"" + std::to_string(size.rows) + "\"/>";
}

std::string vrt_source(const RasterPart& part) {
    // States the properties of the part, because otherwise GDAL would open every part to find them.
    const std::string side = std::to_string(GeoTiffFile::tile);
    return "    <SimpleSource><SourceFilename relativeToVRT=\"1\">" + xml_file_name(part.file) +
           "</SourceFilename><SourceBand>1</SourceBand><SourceProperties RasterXSize=\"" +
           std::to_string(part.cells.cols) + "\" RasterYSize=\"" + std::to_string(part.cells.rows) +
           "\" DataType=\"Float32\" BlockXSize=\"" + side + "\" BlockYSize=\"" + side + "\"/>" +
           vrt_rect("SrcRect", 0, 0, part.cells) +
           vrt_rect("DstRect", part.cells.row, part.cells.col, part.cells) + "</SimpleSource>\n";
}

}  // namespace

GeoTiffFile::GeoTiffFile(WriteTarget target, const std::string& path, const DemInfo& grid,
                         const RasterMetadata& meta)
    : target_(std::move(target)) {
    NameValueList options;
    options.set("TILED", "YES");
    options.set("BLOCKXSIZE", std::to_string(tile));
    options.set("BLOCKYSIZE", std::to_string(tile));
    options.set("COMPRESS", "DEFLATE");
    options.set("PREDICTOR", "3");
    options.set("BIGTIFF", "IF_SAFER");
    // GDAL 3.10 calls a file complete of which a buffered write failed.
    if (!path.starts_with("/vsi")) {
        target_.monitor = &monitor_.emplace();
        target_.hidden_folder = monitor_->name_of(target_.hidden_folder);
    }
    const std::string name = monitor_ ? monitor_->name_of(path) : path;
    OgrCall call(target_);
    dataset_.reset(GDALCreate(GDALGetDriverByName("GTiff"), name.c_str(), grid.window.cols, grid.window.rows,
                              1, GDT_Float32, options.get()));
    call.check(dataset_ != nullptr, "creating the GeoTIFF");
    set_georeferencing(grid, meta);
    describe(meta);
}

void GeoTiffFile::set_georeferencing(const DemInfo& grid, const RasterMetadata& meta) {
    OgrCall call(target_);
    AffineTransform transform = transform_of(grid);
    bool done = !grid.georeferenced || GDALSetGeoTransform(dataset_.get(), transform.data()) == CE_None;
    call.check(done, "placing it");
    if (grid.crs_wkt.empty())
        return;
    const reading::CrsOwner srs = raster_srs(grid.crs_wkt, meta.elevations);
    done = srs != nullptr && GDALSetSpatialRef(dataset_.get(), srs.get()) == CE_None;
    call.check(done, "setting the CRS");
}

void GeoTiffFile::describe(const RasterMetadata& meta) {
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

std::unique_ptr<RasterSink> open_geotiff_sink(const FileTarget& target, const DemInfo& grid,
                                              const RasterMetadata& meta) {
    FileDestination place = resolve_file_target(target);
    require_crs_kept(target.destination, grid, meta);
    return std::make_unique<GeoTiffSink>(std::move(place), grid, meta);
}

std::unique_ptr<PendingResult> prepare_raster_parts(const std::filesystem::path& vrt, std::int32_t rows,
                                                    std::int32_t cols, const std::vector<RasterPart>& parts) {
    std::string text = vrt_header((vrt.parent_path() / parts.at(0).file).string(), rows, cols);
    for (const RasterPart& part : parts)
        text += vrt_source(part);
    return prepare_text_file(vrt, text + "  </VRTRasterBand>\n</VRTDataset>\n");
}

}  // namespace d2b::writing
