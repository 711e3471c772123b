#include <algorithm>
#include <cmath>

#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/cutline_mask.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/side_rasters.hpp"
#include "read/warning_source.hpp"
#include "read/window.hpp"

namespace d2b {

namespace {

class RasterMask final : public WarningSource {
  public:
    RasterMask(const SideRaster& mask, const DemInfo& grid, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)), raster_("mask", mask, grid, Resampling::nearest, warnings()) {
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(const Window& part, std::span<double> inside) override {
        raster_.read(part, inside);
        for (double& value : inside)
            value = std::isnan(value) || value == 0 ? 0 : 1;
    }

  private:
    AlignedRaster raster_;
};

class PolygonMask final : public WarningSource {
  public:
    PolygonMask(const PolygonPlace& place, const DemInfo& grid, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          info_(grid),
          mask_(read_cutline(place, grid, warnings()), grid.window) {
        info_.name = place.path;
        if (!mask_.meets_window())
            throw InputError("The mask '" + place.path + "' has no polygon in the part of '" + grid.name +
                             "' that is used; give one of the same area.");
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return info_; }

    void read(const Window& part, std::span<double> inside) override {
        require_part(info_, part, inside.size());
        std::fill(inside.begin(), inside.end(), 1.0);
        mask_.apply(part, inside);
        for (double& value : inside)
            value = std::isnan(value) ? 0 : 1;
    }

  private:
    DemInfo info_;
    CutlineMask mask_;
};

/// Returns true if a dataset has layers and no bands.
bool is_vector(const std::string& path, Warnings& warnings) {
    const GdalMessages messages;
    const DatasetOwner dataset =
        open_gated(path, GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
    if (!dataset)
        throw InputError("The mask '" + path +
                         "' cannot be opened as a raster or as polygons: " + messages.reason_for(path) + ".");
    messages.pass_warnings(warnings);  // GDAL repeats some of them at no later opening
    return GDALGetRasterCount(dataset.get()) == 0 && GDALDatasetGetLayerCount(dataset.get()) > 0;
}

}  // namespace

std::unique_ptr<DemSource> open_mask(const SideRaster& mask, const std::string& layer, const DemInfo& grid,
                                     const Callbacks& callbacks) {
    const std::string& path = mask.path;
    auto warnings = std::make_unique<Warnings>(callbacks.on_warning);
    // Standard input can be opened only once, and GDAL reads no rasters from it by itself.
    if (mask.array == nullptr && !is_standard_input(path) && is_vector(path, *warnings))
        return std::make_unique<PolygonMask>(PolygonPlace{"mask", "mask_layer", path, layer}, grid,
                                             std::move(warnings));
    if (!layer.empty())
        throw OptionError("The mask '" + path + "' is a raster and has no layers; leave out -mask_layer.");
    return std::make_unique<RasterMask>(mask, grid, std::move(warnings));
}

}  // namespace d2b
