#include <optional>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/number_text.hpp"
#include "core/undeclared_values.hpp"
#include "core/units.hpp"
#include "dem2buildings/error.hpp"
#include "read/aligned_raster.hpp"
#include "read/side_rasters.hpp"
#include "read/warning_source.hpp"

namespace d2b {

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
    TerrainSource(const SideRaster& raster, const DemInfo& grid, double dem_metres,
                  const ElevationLimits& limits, const TerrainReading& reading, std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          raster_("terrain", raster, grid, Resampling::bilinear, warnings()),
          dem_metres_(dem_metres),
          undecided_(!reading.keeps_undeclared),
          read_(grid.window.rows),
          unread_(grid.window.points()) {
        if (const auto unit = vertical_unit(raster_.raster()))
            factor_ = unit->metres / dem_metres;
        limits_ = limits.times(1 / factor_);
        raster_.take_only(limits_);
        if (reading.gaps == TerrainGaps::warned_of)
            raster_.warn_of_gaps("there is no ground");
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
        if (std::exchange(undecided_, false))
            decide_undeclared();
        raster_.read(part, elevations);
        if (factor_ != 1)
            for (double& elevation : elevations)
                elevation *= factor_;
        if (is_last(part))
            judge();
    }
    [[nodiscard]] double share_outside() const override { return raster_.share_outside(); }
    [[nodiscard]] std::int64_t cells_outside_range() const override {
        return raster_.counts().outside.cells() + raster_.counts().undeclared.cells();
    }

  private:
    /// Returns true if this part completes the window.
    [[nodiscard]] bool is_last(const Window& part);
    void judge() {
        judge_outside();
        judge_undeclared();
    }
    void judge_outside();
    void judge_undeclared();
    void decide_undeclared();
    /// Advice on declaring a value, in the units of the file.
    [[nodiscard]] std::string declaring(double value) const {
        return "declare that with gdal_edit.py -a_nodata " + value_text(raster_.stored(value));
    }

    AlignedRaster raster_;
    double factor_ = 1;
    double dem_metres_;
    bool undecided_;  ///< undeclared NoData values are still to be found
    std::vector<double> taken_;
    ElevationLimits limits_;
    SeenCells read_;
    std::int64_t unread_;  ///< cells of the window
};

bool TerrainSource::is_last(const Window& part) {
    if (unread_ == 0)
        return false;
    for (std::int32_t row = part.row; row < part.end_row(); ++row)
        read_.add(row - info().window.row, part.col, part.end_col(),
                  [this](std::int32_t begin, std::int32_t end) { unread_ -= end - begin; });
    return unread_ == 0;
}

void TerrainSource::judge_outside() {
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
    warnings().add(what + ", and " + (outside.cells() == 1 ? "is" : "are") + " treated as no data; declare " +
                   (most ? "that with gdal_edit.py -a_nodata " + value_text(raster_.stored(most->value))
                         : "it with gdal_edit.py -a_nodata") +
                   ", or give the range with -zrange.");
}

}  // namespace

void TerrainSource::judge_undeclared() {
    const ValueCounts& undeclared = raster_.counts().undeclared;
    for (const double value : taken_)
        if (const std::int64_t cells = undeclared.cells_of(value).value_or(0); cells > 0)
            warnings().add(undeclared_text({value, cells}, "the " + raster_.name()) +
                           ", so they are treated as no data; " + declaring(value) +
                           ", or keep the elevation with -inodata.");
}

void TerrainSource::decide_undeclared() {
    const UndeclaredValues found =
        raster_.take_undeclared_out(UndeclaredRules::step_m / (factor_ * dem_metres_), limits_);
    taken_ = found.values();
    for (const SharedValue& named : found.named)
        warnings().add(undeclared_text(named, "the " + raster_.name()) + "; if it stands for no data, " +
                       declaring(named.value) + ", and if not, give -inodata.");
}

std::unique_ptr<DemSource> open_terrain(const SideRaster& raster, const DemInfo& grid,
                                        double dem_vertical_metres, const ElevationLimits& limits,
                                        const Callbacks& callbacks, const TerrainReading& reading) {
    return std::make_unique<TerrainSource>(raster, grid, dem_vertical_metres, limits, reading,
                                           std::make_unique<Warnings>(callbacks.on_warning));
}

}  // namespace d2b
