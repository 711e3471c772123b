#include "write/geotiff_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <cpl_vsi.h>

#include "core/error.hpp"
#include "write/config_option.hpp"
#include "write/existing_dataset.hpp"
#include "write/geotiff_file.hpp"
#include "write/staging.hpp"

namespace d2b {

namespace {

class GeoTiffSink final : public RasterSink {
  public:
    GeoTiffSink(RasterPlace place, DemInfo grid, RasterMeta meta, Context& context)
        : place_(std::move(place)),
          grid_(std::move(grid)),
          meta_(std::move(meta)),
          target_{.name = place_.name, .hidden_folder = "", .context = &context} {}
    ~GeoTiffSink() override;

    void write(std::int32_t rows, std::span<const float> values) override;
    void finish() override;

  private:
    [[nodiscard]] std::size_t cols() const { return static_cast<std::size_t>(grid_.window.cols); }
    void begin();
    void write_strip();
    void publish();

    RasterPlace place_;
    DemInfo grid_;
    RasterMeta meta_;
    WriteTarget target_;
    std::optional<Staging> staging_;
    std::string beside_;               ///< what is written meanwhile in a virtual file system
    std::optional<GeoTiffFile> file_;  ///< goes before the folder that it is in
    std::vector<float> strip_;         ///< rows that do not fill a row of tiles yet
    std::int32_t written_ = 0;         ///< rows
};

GeoTiffSink::~GeoTiffSink() {
    const GdalMessages quiet;
    file_.reset();
    if (!beside_.empty())
        VSIUnlink(beside_.c_str());
}

void GeoTiffSink::begin() {
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    std::string path;
    if (place_.local) {
        staging_.emplace(place_.name, place_.path);
        target_.hidden_folder = staging_->folder().string() + "/";
        path = staging_->dataset().string();
    } else {
        path = beside_ = place_.path + ".part";
    }
    file_.emplace(target_, path, grid_, meta_);
}

void GeoTiffSink::write(std::int32_t rows, std::span<const float> values) {
    const std::int32_t left =
        grid_.window.rows - written_ - static_cast<std::int32_t>(strip_.size() / cols());
    if (rows < 0 || rows > left || values.size() != static_cast<std::size_t>(rows) * cols())
        throw OutputError("Cannot write \"" + place_.name + "\": " + std::to_string(values.size()) +
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
        throw OutputError("Cannot write \"" + place_.name + "\": " + std::to_string(written_) + " of its " +
                          std::to_string(grid_.window.rows) + " rows were given.");
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    file_->close();
    publish();
}

void GeoTiffSink::publish() {
    if (!staging_) {
        OgrCall call(target_);
        if (!place_.old_files.empty())
            VSIUnlink(place_.path.c_str());
        call.check(VSIRename(beside_.c_str(), place_.path.c_str()) == 0, "renaming the finished result");
        beside_.clear();
        return;
    }
    staging_->seal();
    staging_->sync();
    if (stamp_of(place_.old_files) != place_.stamp)
        throw OutputError("\"" + place_.name +
                          "\" has changed while this run was going on and is left alone; run again.");
    staging_->publish(place_.old_files);
    staging_.reset();
}

}  // namespace

std::unique_ptr<RasterSink> open_geotiff_sink(const RasterTarget& target, const DemInfo& grid,
                                              const RasterMeta& meta, Context& context) {
    return std::make_unique<GeoTiffSink>(locate_raster(target), grid, meta, context);
}

}  // namespace d2b
