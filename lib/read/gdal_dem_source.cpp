#include <algorithm>
#include <string>
#include <utility>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/cutline_mask.hpp"
#include "read/gdal_messages.hpp"
#include "read/open_raster.hpp"
#include "read/raster_crs.hpp"
#include "read/raster_transform.hpp"
#include "read/shared_raster.hpp"
#include "read/standard_input.hpp"
#include "read/start_gdal.hpp"
#include "read/warning_source.hpp"
#include "read/window.hpp"

namespace d2b {

namespace {

void describe_values(GDALRasterBandH band, const ReadOptions& options, DemInfo& info) {
    int known = FALSE;
    if (const double scale = GDALGetRasterScale(band, &known); known != FALSE)
        info.scale = scale;
    if (const double offset = GDALGetRasterOffset(band, &known); known != FALSE)
        info.offset = offset;
    if (!options.nodata && !options.ignore_nodata)
        return;
    const double nodata = GDALGetRasterNoDataValue(band, &known);
    if (known != FALSE && nodata != options.nodata)
        info.set_aside_nodata = nodata * info.scale + info.offset;
}

bool holds_bytes(GDALRasterBandH band) {
    return GDALGetRasterDataType(band) == GDT_Byte && GDALGetRasterScale(band, nullptr) == 1 &&
           GDALGetRasterOffset(band, nullptr) == 0;
}

DemInfo describe(const OpenRaster& raster, const ReadOptions& options, Warnings& warnings) {
    const GdalMessages messages(GDALGetDescription(raster.dataset.get()), options.source);
    DemInfo info;
    info.name = options.source;
    info.rows = GDALGetRasterYSize(raster.dataset.get());
    info.cols = GDALGetRasterXSize(raster.dataset.get());
    if (const GDALDriverH driver = GDALGetDatasetDriver(raster.dataset.get()))
        info.driver = GDALGetDriverShortName(driver);
    if (const char* unit = GDALGetRasterUnitType(raster.band))
        info.band_unit = unit;
    describe_values(raster.band, options, info);
    info.bands = GDALGetRasterCount(raster.dataset.get());
    info.bytes = holds_bytes(raster.band);
    read_transform(raster.dataset.get(), info, warnings);
    read_crs(raster.dataset.get(), options.crs, info, warnings);
    info.window = choose_window(options, info);
    if (const std::string doubt = doubt_of_extent(options, info); !doubt.empty())
        warnings.add(doubt);
    int block_cols = 0;
    GDALGetBlockSize(raster.band, &block_cols, &info.block_rows);
    info.block_rows = std::clamp(info.block_rows, 1, std::max(info.rows, 1));
    messages.pass_all(warnings);
    return info;
}

class GdalDemSource final : public WarningSource {
  public:
    GdalDemSource(std::unique_ptr<KeptStandardInput> standard_input, OpenRaster raster,
                  const ReadOptions& options, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          standard_input_(std::move(standard_input)),
          info_(describe(raster, options, warnings())),
          readers_(share_raster(std::move(raster), options,
                                standard_input_ ? standard_input_->path() : options.source, info_,
                                warnings())),
          cutline_(open_cutline(options, info_, warnings())) {
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return info_; }

    void read(const Window& part, std::span<double> elevations) override {
        readers_->read(part, elevations);
        if (cutline_)
            cutline_->apply(part, elevations);
    }

  private:
    std::unique_ptr<KeptStandardInput> standard_input_;  // first, as the readers must be closed before it
    DemInfo info_;
    std::unique_ptr<SharedRaster> readers_;
    std::unique_ptr<CutlineMask> cutline_;
};

}  // namespace

std::unique_ptr<DemSource> open_dem(const ReadOptions& options, const Callbacks& callbacks) {
    register_formats();
    auto warnings = std::make_unique<Warnings>(callbacks.on_warning);
    std::unique_ptr<KeptStandardInput> standard_input = keep_standard_input(options.source);
    OpenRaster raster =
        open_raster(options, standard_input ? standard_input->path() : options.source, *warnings);
    return std::make_unique<GdalDemSource>(std::move(standard_input), std::move(raster), options,
                                           std::move(warnings));
}

}  // namespace d2b
