#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/cutline.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/open_dem.hpp"
#include "read/temporary_file.hpp"

namespace d2b::reading {
namespace {

class RasterMask final : public WarningSource {
  public:
    RasterMask(const AuxiliaryRaster& mask, const DemInfo& grid, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          raster_("mask", mask, grid, Resampling::nearest, warnings()),
          first_reads_(grid.window) {
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(const Window& part, std::span<double> inside) override {
        raster_.read(part, inside);
        const auto count = [this](std::span<const double> cells) {
            for (const double value : cells)
                if (is_unusual(value))
                    unusual_.add(value);
                else if (value > 0)
                    marked_ = true;
        };
        const bool complete = first_reads_.add(part, inside, count);
        for (double& value : inside)
            value = std::isnan(value) || value == 0 ? 0 : 1;
        if (complete)
            report_unusual();
    }

  private:
    /// Returns true for a value that often stands for no data, and hardly for a class.
    [[nodiscard]] static bool is_unusual(double value) { return value < 0 || value >= 255; }
    /// Warns of an unusual value beside others that mark the inside.
    void report_unusual() {
        if (const auto most = unusual_.most(); marked_ && most)
            warnings().add(cells_have(most->cells, "the " + raster_.name()) + "the value " +
                           value_text(most->value) + (most->cells == 1 ? " and counts" : " and count") +
                           " as inside; if it stands for no data, " +
                           raster_.declaration_advice(most->value) + ".");
    }

    AlignedRaster raster_;
    FirstReads first_reads_;
    ValueCounts unusual_;
    bool marked_ = false;  ///< other values mark cells as inside
};

class PolygonMask final : public WarningSource {
  public:
    PolygonMask(const PolygonSource& place, const DemInfo& grid, std::unique_ptr<Warnings> own,
                double buffer_m = 0)
        : WarningSource(std::move(own)),
          info_(grid),
          mask_(polygons_of(place, grid, buffer_m, warnings()), grid.window) {
        info_.name = place.path;
        warnings().hold();
    }

    [[nodiscard]] bool meets_window() const { return mask_.meets_window(); }

    [[nodiscard]] const DemInfo& info() const override { return info_; }

    void read(const Window& part, std::span<double> inside) override {
        require_part(info_, part, inside.size());
        std::fill(inside.begin(), inside.end(), 1.0);
        mask_.apply(part, inside);
        for (double& value : inside)
            value = std::isnan(value) ? 0 : 1;
    }

  private:
    [[nodiscard]] static std::vector<PixelPolygon> polygons_of(const PolygonSource& place,
                                                               const DemInfo& grid, double buffer_m,
                                                               Warnings& warnings) {
        std::vector<PixelPolygon> polygons = read_cutline(place, grid, warnings);
        return buffer_m > 0 ? buffered(polygons, buffer_m, grid, place.name()) : polygons;
    }

    DemInfo info_;
    CutlineMask mask_;
};

/// Returns true if a dataset has layers and no bands.
bool is_vector(const std::string& path, Warnings& warnings) {
    const GdalMessages messages;
    const DatasetOwner dataset =
        open_guarded(path, GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
    if (!dataset)
        throw InputError("The mask '" + path +
                         "' cannot be opened as a raster or as polygons: " + messages.reason_for(path) + ".");
    messages.pass_warnings(warnings);  // GDAL repeats some of them at no later opening
    return GDALGetRasterCount(dataset.get()) == 0 && GDALDatasetGetLayerCount(dataset.get()) > 0;
}

std::unique_ptr<DemSource> open_polygon_mask(const std::string& path, const std::string& layer,
                                             const DemInfo& grid, std::unique_ptr<Warnings> warnings) {
    auto mask = std::make_unique<PolygonMask>(PolygonSource{"mask", "mask_layer", path, layer}, grid,
                                              std::move(warnings));
    if (!mask->meets_window())
        throw InputError("The mask '" + path + "' has no polygon in the part of '" + grid.name +
                         "' that is used; give one of the same area.");
    return mask;
}

}  // namespace

std::unique_ptr<DemSource> open_exclusion(const ExclusionChoice& choice, const DemInfo& grid,
                                          const Callbacks& callbacks) {
    const PolygonSource place{"exclusion dataset", "exclude_layer", choice.dataset, choice.layer};
    auto mask = std::make_unique<PolygonMask>(place, grid, std::make_unique<Warnings>(callbacks.on_warning),
                                              choice.buffer_m);
    if (!mask->meets_window() && callbacks.on_warning)
        callbacks.on_warning("The " + place.name() + " has no polygon in the part of '" + grid.name +
                             "' that is used, so it leaves nothing out.");
    return mask;
}

std::unique_ptr<DemSource> open_mask(const AuxiliaryRaster& mask, const std::string& layer,
                                     const DemInfo& grid, const Callbacks& callbacks) {
    const std::string& path = mask.path;
    auto warnings = std::make_unique<Warnings>(callbacks.on_warning);
    // Standard input can be opened only once, and GDAL reads no rasters from it by itself.
    if (mask.array == nullptr && !is_standard_input(path) && is_vector(path, *warnings))
        return open_polygon_mask(path, layer, grid, std::move(warnings));
    if (!layer.empty())
        throw OptionError("The mask '" + path + "' is a raster and has no layers; leave out -mask_layer.");
    return std::make_unique<RasterMask>(mask, grid, std::move(warnings));
}

}  // namespace d2b::reading
