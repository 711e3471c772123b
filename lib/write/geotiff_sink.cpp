#include "write/geotiff_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <cpl_vsi.h>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/config_option.hpp"
#include "write/geotiff_file.hpp"
#include "write/staged_raster.hpp"

namespace d2b {

namespace {

class GeoTiffSink final : public RasterSink {
  public:
    GeoTiffSink(RasterPlace place, DemInfo grid, RasterMeta meta)
        : staged_(std::move(place)), grid_(std::move(grid)), meta_(std::move(meta)) {}
    ~GeoTiffSink() override;

    void write(std::int32_t rows, std::span<const float> values) override;
    void finish() override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return staged_.take_warnings(); }

  private:
    [[nodiscard]] std::size_t cols() const { return static_cast<std::size_t>(grid_.window.cols); }
    void begin();
    void write_strip();

    StagedRaster staged_;
    DemInfo grid_;
    RasterMeta meta_;
    std::optional<GeoTiffFile> file_;  ///< goes before the folder that it is in
    std::vector<float> strip_;         ///< rows that do not fill a row of tiles yet
    std::int32_t written_ = 0;         ///< rows
};

GeoTiffSink::~GeoTiffSink() {
    const GdalMessages quiet;
    file_.reset();
}

void GeoTiffSink::begin() {
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    file_.emplace(staged_.target(), staged_.begin(), grid_, meta_);
}

void GeoTiffSink::write(std::int32_t rows, std::span<const float> values) {
    const std::int32_t left =
        grid_.window.rows - written_ - static_cast<std::int32_t>(strip_.size() / cols());
    if (rows < 0 || rows > left || values.size() != static_cast<std::size_t>(rows) * cols())
        throw OutputError("Cannot write \"" + staged_.name() + "\": " + std::to_string(values.size()) +
                          " values were given for " + std::to_string(rows) + " rows, of which it has " +
                          std::to_string(left) + " of " + std::to_string(cols()) + " columns left.");
    constexpr auto full = static_cast<std::size_t>(GeoTiffFile::tile);
    for (std::size_t at = 0; at < values.size(); at += cols()) {
        for (const float value : values.subspan(at, cols()))
            strip_.push_back(std::isfinite(value) ? value : GeoTiffFile::nodata);
        if (strip_.size() == full * cols())
            write_strip();
    }
}

void GeoTiffSink::write_strip() {
    if (!file_)
        begin();
    const auto rows = static_cast<std::int32_t>(strip_.size() / cols());
    file_->write(written_, rows, strip_);
    written_ += rows;
    strip_.clear();
}

void GeoTiffSink::finish() {
    if (!strip_.empty())
        write_strip();
    if (written_ != grid_.window.rows)
        throw OutputError("Cannot write \"" + staged_.name() + "\": " + std::to_string(written_) +
                          " of its " + std::to_string(grid_.window.rows) + " rows were given.");
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    file_->close();
    staged_.publish("renaming the finished result");
}

/// By a trial of one cell: what GDAL has no keys of GeoTIFF for goes into a file beside, which would outlive
/// a run that fails, or nowhere.
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
