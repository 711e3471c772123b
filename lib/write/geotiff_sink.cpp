#include "write/geotiff_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <cpl_vsi.h>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "read/config_option.hpp"
#include "read/gdal_messages.hpp"
#include "write/file_sink.hpp"
#include "write/geotiff_file.hpp"
#include "write/staged_raster.hpp"

namespace d2b {

namespace {

/// Buffers cells until their tile is complete, because a tile that is compressed twice leaves a gap in the
/// file.
class GeoTiffSink final : public FileSink<RasterSink> {
  public:
    GeoTiffSink(RasterPlace place, DemInfo grid, RasterMeta meta)
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
    [[nodiscard]] std::size_t number_of(const Window& tile) const;
    /// Copies the cells of a part that lie in a tile. @param values cells of the part
    void take(const Window& tile, const Window& part, std::span<const float> values);
    void begin();

    StagedRaster staged_;
    DemInfo grid_;
    RasterMeta meta_;
    std::optional<GeoTiffFile>
        file_;  ///< declared after the staged raster, because it must be closed before its folder is removed
    std::vector<std::int64_t> missing_;                ///< missing cells per tile, row-major
    std::map<std::size_t, std::vector<float>> tiles_;  ///< incomplete tiles
};

GeoTiffSink::~GeoTiffSink() {
    const GdalMessages quiet;
    file_.reset();
}

Window GeoTiffSink::tile_at(const Window& cell) const {
    constexpr std::int32_t side = GeoTiffFile::tile;
    const Window tile{cell.row / side * side, cell.col / side * side, side, side};
    return {tile.row, tile.col, std::min(side, grid_.window.rows - tile.row),
            std::min(side, grid_.window.cols - tile.col)};
}

std::size_t GeoTiffSink::number_of(const Window& tile) const {
    constexpr std::int32_t side = GeoTiffFile::tile;
    const std::int64_t across = (std::int64_t{grid_.window.cols} + side - 1) / side;
    return static_cast<std::size_t>(tile.row / side * across + tile.col / side);
}

void GeoTiffSink::begin() {
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
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
                          " columns from " + std::to_string(part.col) + " on, which are no part of it.");
    Window tile;
    for (std::int32_t row = here.row; row < here.end_row(); row = tile.end_row())
        for (std::int32_t col = here.col; col < here.end_col(); col = tile.end_col()) {
            tile = tile_at({row, col, 1, 1});
            take(tile, here, values);
        }
}

void GeoTiffSink::take(const Window& tile, const Window& part, std::span<const float> values) {
    const std::int32_t row = std::max(tile.row, part.row);
    const std::int32_t col = std::max(tile.col, part.col);
    const Window both{row, col, std::min(tile.end_row(), part.end_row()) - row,
                      std::min(tile.end_col(), part.end_col()) - col};
    const std::size_t number = number_of(tile);
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
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    file_->close();
    staged_.prepare(commit);
}

/// Tests with a raster of one cell that GeoTIFF can hold the CRS. GDAL drops a CRS without GeoTIFF keys or
/// writes it to a sidecar file, which would outlive a failed run.
void require_crs_kept(const std::string& name, DemInfo grid, const RasterMeta& meta) {
    if (grid.crs_wkt.empty())
        return;
    grid.window.rows = grid.window.cols = 1;
    const GdalMessages quiet;
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    const std::string file =
        "/vsimem/d2b_crs_" + std::to_string(reinterpret_cast<std::uintptr_t>(&grid)) + ".tif";
    const WriteTarget target{.name = name, .hidden_folder = ""};
    GeoTiffFile(target, file, grid, meta).close();
    DatasetOwner dataset(GDALOpen(file.c_str(), GA_ReadOnly));
    const bool kept = dataset && GDALGetSpatialRef(dataset.get()) != nullptr;
    dataset.reset();
    VSIUnlink(file.c_str());
    if (!kept)
        throw OutputError(
            "Cannot write \"" + name + "\": GeoTIFF cannot hold the coordinate reference system '" +
            Crs(grid.crs_wkt).name() + "' of the DEM; convert it to another one with gdalwarp first.");
}

}  // namespace

std::unique_ptr<RasterSink> open_geotiff_sink(const RasterTarget& target, const DemInfo& grid,
                                              const RasterMeta& meta) {
    RasterPlace place = locate_raster(target);
    require_crs_kept(target.destination, grid, meta);
    return std::make_unique<GeoTiffSink>(std::move(place), grid, meta);
}

}  // namespace d2b
