#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/open_dem.hpp"

namespace d2b::reading {
namespace {

constexpr double rounding = 1e-6;  // single precision and scales such as 1/10000

class NdviSource final : public WarningSource {
  public:
    NdviSource(const AuxiliaryRaster& raster, const DemInfo& grid, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          raster_("NDVI", raster, grid, Resampling::bilinear, warnings()),
          first_reads_(grid.window) {
        raster_.warn_about_gaps("nothing is known of vegetation");
        exclude_undeclared();
        // Reads one row, because a wrong product shows in any row and a run should not fail at its end.
        std::vector<double> row(static_cast<std::size_t>(grid.window.cols));
        read_values({grid.window.row + grid.window.rows / 2, grid.window.col, 1, grid.window.cols}, row);
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(const Window& part, std::span<double> values) override {
        read_values(part, values);
        const auto count_missing = [this](std::span<const double> cells) {
            missing_ += std::ranges::count_if(cells, [](double value) { return std::isnan(value); });
        };
        if (first_reads_.add(part, values, count_missing)) {
            raster_.warn_about_blended(margin_);
            report_missing();
        }
    }

  private:
    /// Takes values for no data that lie at the edge of the raster and are no index. Those of more than half
    /// of the cells are refused later, because another product may have been given.
    void exclude_undeclared() {
        constexpr double step = 0.5;  // to the index around
        raster_.restrict_to({}, 1);
        const UndeclaredNodata found = raster_.find_undeclared(step, {});
        std::vector<double> excluded;
        for (const std::vector<SharedValue>& some : {found.taken, found.named})
            for (const auto& [value, cells] : some)
                if (std::abs(value) > 1 + rounding && 2 * cells <= raster_.used_cells()) {
                    excluded.push_back(value);
                    warnings().add(cells_have(cells, "the " + raster_.name()) + "the value " +
                                   value_text(value) +
                                   " and lie at its edge, so they are treated as no data; " +
                                   raster_.declaration_advice(value) + ".");
                }
        margin_ = raster_.find_blended(excluded, step, {-1 - rounding, 1 + rounding});
        raster_.exclude(std::move(excluded), margin_);
    }
    /// Warns of cells without a value, if they exceed the part outside of the raster, of which a warning
    /// tells, and are not all. Resampling loses cells along borders.
    void report_missing() {
        const Window& window = info().window;
        const double share = static_cast<double>(missing_) / static_cast<double>(window.points());
        if (missing_ >= std::int64_t{window.rows} + window.cols && missing_ < window.points() &&
            share > 1.02 * raster_.share_outside())
            warnings().add(percent_text(share) + " of the cells have no value in the " + raster_.name() +
                           "; nothing is known of vegetation there.");
    }
    void read_values(const Window& part, std::span<double> values) {
        raster_.read(part, values);
        for (double& value : values) {
            if (value < -1 - rounding || value > 1 + rounding)
                throw InputError(
                    "The " + raster_.name() + " has the value " + number_text(value) +
                    ", and an NDVI lies between -1 and 1; if it stands for no data, " +
                    raster_.declaration_advice(value) +
                    ", else set the scale of a scaled product, for example with gdal_edit.py -scale 0.0001, "
                    "or compute it as (NIR - red) / (NIR + red) and clamp it.");
            value = value < -1 ? -1 : value > 1 ? 1 : value;  // NaN stays NaN
        }
    }

    AlignedRaster raster_;
    BlendedMargin margin_;
    FirstReads first_reads_;
    std::int64_t missing_ = 0;
};

}  // namespace

std::unique_ptr<DemSource> open_ndvi(const AuxiliaryRaster& raster, const DemInfo& grid,
                                     const Callbacks& callbacks) {
    return std::make_unique<NdviSource>(raster, grid, std::make_unique<Warnings>(callbacks.on_warning));
}

}  // namespace d2b::reading
