#include <algorithm>
#include <vector>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/side_rasters.hpp"
#include "read/warning_source.hpp"

namespace d2b {

namespace {

constexpr double rounding = 1e-6;  // single precision and scales such as 1/10000

class NdviSource final : public WarningSource {
  public:
    NdviSource(const SideRaster& raster, const DemInfo& grid, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)), raster_("NDVI", raster, grid, Resampling::bilinear, warnings()) {
        raster_.warn_of_gaps("nothing is known of vegetation");
        // Reads one row, because a wrong product shows in any row and a run should not fail at its end.
        std::vector<double> row(static_cast<std::size_t>(grid.window.cols));
        read({grid.window.row + grid.window.rows / 2, grid.window.col, 1, grid.window.cols}, row);
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(const Window& part, std::span<double> values) override {
        raster_.read(part, values);
        for (double& value : values) {
            if (value < -1 - rounding || value > 1 + rounding)
                throw InputError(
                    "The " + raster_.name() + " has the value " + number_text(value) +
                    ", and an NDVI lies between -1 and 1; set the scale of a scaled product, for "
                    "example with gdal_edit.py -scale 0.0001, or compute it as (NIR - red) / (NIR "
                    "+ red) and clamp it.");
            value = value < -1 ? -1 : value > 1 ? 1 : value;  // NaN stays NaN
        }
    }

  private:
    AlignedRaster raster_;
};

}  // namespace

std::unique_ptr<DemSource> open_ndvi(const SideRaster& raster, const DemInfo& grid,
                                     const Callbacks& callbacks) {
    return std::make_unique<NdviSource>(raster, grid, std::make_unique<Warnings>(callbacks.on_warning));
}

}  // namespace d2b
