#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/georeferencing.hpp"
#include "read/open_dem.hpp"

namespace d2b::reading {
namespace {

std::optional<LengthUnit> vertical_unit(const DemInfo& raster) {
    if (auto band = stated_unit(raster.band_unit, "terrain '" + raster.name + "'", "gdal_edit.py -units"))
        return band;
    return Crs(raster.crs_wkt).vertical_unit();
}

/// Returns the name of the reference surface of heights, or "" if it is unknown.
std::string height_reference(const std::string& wkt) {
    const CrsOwner crs(wkt.empty() ? nullptr : OSRNewSpatialReference(wkt.c_str()));
    if (!crs)
        return {};
    if (OSRIsCompound(crs.get()) == FALSE)
        return OSRGetAxesCount(crs.get()) == 3 ? "the ellipsoid" : "";
    const char* datum = OSRGetAttrValue(crs.get(), "VERT_DATUM", 0);
    return datum == nullptr ? "" : datum;
}

class TerrainSource final : public WarningSource {
  public:
    TerrainSource(const AuxiliaryRaster& raster, const DemInfo& grid, double dem_metres,
                  const ElevationLimits& limits, const TerrainReadOptions& reading,
                  std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          raster_("terrain", raster, grid, Resampling::bilinear, warnings()),
          dem_metres_(dem_metres),
          keeps_undeclared_(reading.keeps_undeclared),
          undeclared_pending_(!keeps_undeclared_),
          first_reads_(grid.window) {
        if (const auto unit = vertical_unit(raster_.raster()))
            factor_ = unit->metres / dem_metres;
        limits_ = limits.times(1 / factor_);
        raster_.restrict_to(limits_, factor_ * dem_metres_);
        if (reading.gaps == TerrainGaps::reported)
            raster_.warn_about_gaps("there is no ground");
        const std::string here = height_reference(raster_.raster().crs_wkt);
        const std::string dem = height_reference(grid.crs_wkt);
        if (!here.empty() && !dem.empty() && here != dem)
            warnings().add("Heights of the " + raster_.name() + " are above " + here + " and those of '" +
                           grid.name + "' above " + dem +
                           "; they are compared as they are, so convert one of them with gdalwarp first.");
        warnings().hold();
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(const Window& part, std::span<double> elevations) override {
        if (std::exchange(undeclared_pending_, false))
            detect_undeclared();
        raster_.read(part, elevations);
        if (factor_ != 1)
            for (double& elevation : elevations)
                elevation *= factor_;
        if (first_reads_.add(part, elevations, [](std::span<const double>) {}))
            report_values();
    }
    [[nodiscard]] double share_outside() const override { return raster_.share_outside(); }
    [[nodiscard]] std::int64_t cells_outside_range() const override {
        const LimitCounts& counts = raster_.counts();
        return counts.outside.cells() + counts.undeclared.cells() + counts.blended;
    }

  private:
    void report_values() {
        report_outside();
        report_undeclared();
        raster_.warn_about_blended(margin_);
        report_shared();
    }
    void report_outside();
    void report_undeclared();
    void report_shared();
    void detect_undeclared();

    AlignedRaster raster_;
    double factor_ = 1;
    double dem_metres_;
    bool keeps_undeclared_;
    bool undeclared_pending_;  ///< undeclared NoData values are still to be found
    std::vector<double> excluded_;
    BlendedMargin margin_;
    std::vector<SharedValue> named_;  ///< undeclared values that are kept, with a warning
    ElevationLimits limits_;
    FirstReads first_reads_;
};

void TerrainSource::report_outside() {
    const std::int64_t within = raster_.counts().within;
    const ValueCounts& outside = raster_.counts().outside;
    if (outside.cells() == 0)
        return;
    const std::string what = outside.text("the " + raster_.name()) + ", outside of the range from " +
                             number_text(limits_.lowest) + " to " + number_text(limits_.highest);
    if (outside.cells() > within)
        throw InputError(what +
                         " and more than half of all; correct its unit with gdal_edit.py -units or its "
                         "NoData value with gdal_edit.py -a_nodata, or give the range with -zrange.");
    const auto most = outside.most();
    warnings().add(
        what + ", and " + (outside.cells() == 1 ? "is" : "are") + " treated as no data; " +
        (most ? raster_.declaration_advice(most->value) : "declare it with gdal_edit.py -a_nodata") +
        ", or give the range with -zrange.");
}

void TerrainSource::report_undeclared() {
    const ValueCounts& undeclared = raster_.counts().undeclared;
    for (const double value : excluded_)
        if (const std::int64_t cells = undeclared.cells_of(value).value_or(0); cells > 0)
            warnings().add(undeclared_text({value, cells}, "the " + raster_.name()) +
                           ", so they are treated as no data; " +
                           (margin_.cells > 0 && margin_.with == value
                                ? ""
                                : raster_.declaration_advice(value) + ", or ") +
                           "keep the elevation with -inodata.");
}

void TerrainSource::report_shared() {
    const std::int64_t within = raster_.counts().within;
    if (const auto low = raster_.counts().bins->far_below(within);
        !keeps_undeclared_ && low && 2 * low->cells <= within &&
        std::ranges::find(named_, low->value, &SharedValue::value) == named_.end()) {
        warnings().add(far_below_text(*low, "the " + raster_.name()) + "; if it stands for no data, " +
                       raster_.declaration_advice(low->value) + ", and if not, give -inodata.");
        named_.push_back(*low);
    }
    for (const auto& [value, cells] : raster_.counts().bins->shared(within))
        if (2 * cells <= within && std::ranges::find(named_, value, &SharedValue::value) == named_.end())
            warnings().add(isolated_text({value, cells}, "the " + raster_.name()) +
                           "; if it stands for no data, " + raster_.declaration_advice(value) + ".");
}

void TerrainSource::detect_undeclared() {
    const double step = UndeclaredNodataRules::step_m / (factor_ * dem_metres_);
    const UndeclaredNodata found = raster_.find_undeclared(step, limits_);
    excluded_ = found.values();
    margin_ = raster_.find_blended(excluded_, step, limits_);
    raster_.exclude(excluded_, margin_);
    named_ = found.named;
    for (const SharedValue& named : named_)
        warnings().add(undeclared_text(named, "the " + raster_.name()) + "; if it stands for no data, " +
                       raster_.declaration_advice(named.value) + ", and if not, give -inodata.");
}

}  // namespace

std::unique_ptr<DemSource> open_terrain(const AuxiliaryRaster& raster, const DemInfo& grid,
                                        double dem_vertical_metres, const ElevationLimits& limits,
                                        const Callbacks& callbacks, const TerrainReadOptions& reading) {
    return std::make_unique<TerrainSource>(raster, grid, dem_vertical_metres, limits, reading,
                                           std::make_unique<Warnings>(callbacks.on_warning));
}

}  // namespace d2b::reading
