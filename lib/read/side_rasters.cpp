#include "read/side_rasters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "read/band_reader.hpp"
#include "read/cutline.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/open_dem.hpp"
#include "read/open_raster.hpp"
#include "read/resampling.hpp"
#include "read/temporary_file.hpp"

namespace d2b::reading {

/// First band of a raster, read on the grid and in the window of a DEM. If cells of both coincide, values are
/// those of the raster bit by bit; otherwise they are resampled. Values continue level for half a cell beyond
/// the outermost cell centres of the raster.
class AlignedRaster {
  public:
    /// @param role name of the raster in messages: "terrain"
    /// @throws InputError: cannot be opened, not usable as a raster, no overlap with the window, only one of
    /// the two is georeferenced, no operation between the CRSs
    AlignedRaster(const std::string& role, const AuxiliaryRaster& raster, const DemInfo& grid,
                  Resampling resampling, Warnings& warnings);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Description of the raster itself.
    [[nodiscard]] const DemInfo& raster() const { return raster_; }
    /// Description of the DEM, under the name of the raster.
    [[nodiscard]] const DemInfo& info() const { return info_; }
    /// Warns if part of the window lies outside of the raster. @param consequence "there is no ground"
    void warn_about_gaps(const std::string& consequence) const;

    /// Share of the window outside of the raster.
    [[nodiscard]] double share_outside() const { return 1 - covered_; }

    /// Same as BandReader::restrict_to() and counts().
    void restrict_to(const ElevationLimits& limits, double metres) { reader_.restrict_to(limits, metres); }
    [[nodiscard]] const LimitCounts& counts() const { return reader_.counts(); }
    /// Finds values that stand for NoData without being declared. @param step, limits in the unit of the band
    /// @throws InputError
    [[nodiscard]] UndeclaredNodata find_undeclared(double step, const ElevationLimits& limits);
    /// Number of cells of the raster that cover the window of the DEM.
    [[nodiscard]] std::int64_t used_cells() const { return used_.points(); }
    /// Same as BandReader::exclude().
    void exclude(std::vector<double> undeclared) { reader_.exclude(std::move(undeclared)); }
    /// Returns the advice for a value that stands for no data: "declare that with gdal_edit.py -a_nodata 0".
    [[nodiscard]] std::string declaration_advice(double value) const {
        return is_array_ ? "set these cells to NaN"
                         : "declare that with gdal_edit.py -a_nodata " + value_text(reader_.stored(value));
    }

    /// Same as DemSource::read(), in the unit of the band, with scale and offset applied. @throws InputError
    void read(const Window& part, std::span<double> values);

  private:
    void place(const DemInfo& grid, Resampling resampling);
    [[noreturn]] void throw_no_overlap() const;
    void copy(const Window& part, std::span<double> values);

    Warnings& warnings_;
    std::string name_;
    bool is_array_;
    std::string dem_;                                    ///< name of the DEM, for messages
    std::unique_ptr<StandardInputCopy> standard_input_;  // first, as the dataset must be closed before it
    OpenRaster file_;
    DemInfo raster_;
    DemInfo info_;
    BandReader reader_;
    double covered_ = 0;
    Window used_;  ///< cells of the raster that cover the window of the DEM
    std::optional<CellOffset> offset_;
    std::unique_ptr<ValueWarper> warper_;  ///< null if there is an offset
    std::vector<double> part_;
};

namespace {

DemInfo describe(const OpenRaster& file, const std::string& path, Warnings& warnings) {
    const GdalMessages messages;
    DemInfo info;
    info.name = path;
    info.rows = GDALGetRasterYSize(file.dataset.get());
    info.cols = GDALGetRasterXSize(file.dataset.get());
    info.window = {0, 0, info.rows, info.cols};
    if (const GDALDriverH driver = GDALGetDatasetDriver(file.dataset.get()))
        info.driver = GDALGetDriverShortName(driver);
    if (const char* unit = GDALGetRasterUnitType(file.band))
        info.band_unit = unit;
    Warnings ignored;  // warnings about a missing CRS or georeference concern the DEM alone
    read_transform(file.dataset.get(), info, ignored);
    read_crs(file.dataset.get(), "", info, ignored);
    messages.pass_all(warnings);
    return info;
}

DemInfo on_grid(DemInfo grid, const DemInfo& raster) {
    grid.name = raster.name;
    grid.driver = raster.driver;
    return grid;
}

/// Returns the cells of the raster that cover a window of the DEM, estimated from points along its edge.
Window covering_cells(const GridTransform& transform, const Window& window, const DemInfo& raster) {
    constexpr int steps = 64;
    std::vector<Position> edge;
    for (int i = 0; i <= steps; ++i) {
        const double col = window.col + static_cast<double>(i) / steps * window.cols;
        const double row = window.row + static_cast<double>(i) / steps * window.rows;
        edge.insert(edge.end(), {{col, static_cast<double>(window.row)},
                                 {col, static_cast<double>(window.end_row())},
                                 {static_cast<double>(window.col), row},
                                 {static_cast<double>(window.end_col()), row}});
    }
    transform.to_raster(edge);
    double left = raster.cols;
    double right = 0;
    double top = raster.rows;
    double bottom = 0;
    for (const Position& p : edge)
        if (std::isfinite(p.x) && std::isfinite(p.y)) {
            left = std::min(left, p.x);
            right = std::max(right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
        }
    constexpr double near = 1e-3;  // of a cell, so that coinciding cells stay the same cells
    const auto whole = [](double place, std::int32_t most) {
        return static_cast<std::int32_t>(std::clamp(place, 0.0, static_cast<double>(most)));
    };
    const std::int32_t row = whole(std::floor(top + near), raster.rows);
    const std::int32_t col = whole(std::floor(left + near), raster.cols);
    return {row, col, std::max(0, whole(std::ceil(bottom - near), raster.rows) - row),
            std::max(0, whole(std::ceil(right - near), raster.cols) - col)};
}

std::string percent_text(double share) {
    if (share < 0.01)
        return "Less than 1 %";
    if (share > 0.99)
        return "More than 99 %";
    return "About " + std::to_string(static_cast<int>(std::lround(share * 100))) + " %";
}

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

/// Tells which cells of a window are read for the first time, and when all of them were.
class FirstReads {
  public:
    explicit FirstReads(const Window& window)
        : window_(window), seen_(window.rows), unread_(window.points()) {}

    /// Calls use(values) for runs of cells that were not read before. @param values of the part
    /// @return true if this part completes the window
    template <typename Use>
    [[nodiscard]] bool add(const Window& part, std::span<const double> values, const Use& use) {
        if (unread_ == 0)
            return false;
        for (std::int32_t i = 0; i < part.rows; ++i) {
            const auto row = values.subspan(static_cast<std::size_t>(i) * static_cast<std::size_t>(part.cols),
                                            static_cast<std::size_t>(part.cols));
            seen_.add(part.row + i - window_.row, part.col, part.end_col(),
                      [&](std::int32_t begin, std::int32_t end) {
                          unread_ -= end - begin;
                          use(row.subspan(static_cast<std::size_t>(begin - part.col),
                                          static_cast<std::size_t>(end - begin)));
                      });
        }
        return unread_ == 0;
    }

  private:
    Window window_;
    RowCoverage seen_;
    std::int64_t unread_;  ///< cells
};

class TerrainSource final : public WarningSource {
  public:
    TerrainSource(const AuxiliaryRaster& raster, const DemInfo& grid, double dem_metres,
                  const ElevationLimits& limits, const TerrainReadOptions& reading,
                  std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          raster_("terrain", raster, grid, Resampling::bilinear, warnings()),
          dem_metres_(dem_metres),
          undeclared_pending_(!reading.keeps_undeclared),
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
        return raster_.counts().outside.cells() + raster_.counts().undeclared.cells();
    }

  private:
    void report_values() {
        report_outside();
        report_undeclared();
        report_shared();
    }
    void report_outside();
    void report_undeclared();
    void report_shared();
    void detect_undeclared();

    AlignedRaster raster_;
    double factor_ = 1;
    double dem_metres_;
    bool undeclared_pending_;  ///< undeclared NoData values are still to be found
    std::vector<double> excluded_;
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
        if (first_reads_.add(part, values, count_missing))
            report_missing();
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
        raster_.exclude(std::move(excluded));
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
    FirstReads first_reads_;
    std::int64_t missing_ = 0;
};

}  // namespace

AlignedRaster::AlignedRaster(const std::string& role, const AuxiliaryRaster& raster, const DemInfo& grid,
                             Resampling resampling, Warnings& warnings)
    : warnings_(warnings),
      name_(role + " '" + raster.path + "'"),
      is_array_(raster.array != nullptr),
      dem_("'" + grid.name + "'"),
      standard_input_(raster.array == nullptr ? copy_standard_input(raster.path) : nullptr),
      file_(raster.array != nullptr
                ? array_raster(*raster.array, grid)
                : open_first_band(raster.path, standard_input_ ? standard_input_->path() : raster.path,
                                  warnings)),
      raster_(describe(file_, raster.path, warnings)),
      info_(on_grid(grid, raster_)),
      reader_(file_.band, {}, raster_, warnings) {
    if (raster_.georeferenced != grid.georeferenced) {
        const std::string is = "The " + name_ + " has " + (raster_.georeferenced ? "a" : "no");
        throw InputError(is + " georeference and " + dem_ + " has " +
                         (raster_.georeferenced ? "none" : "one") +
                         "; give both of them one, for example with gdal_edit.py -a_ullr.");
    }
    place(grid, resampling);
}

void AlignedRaster::place(const DemInfo& grid, Resampling resampling) {
    GridTransform transform(name_, raster_, grid);
    const Coverage found = coverage(transform, raster_, info_);
    if (!found.meets)
        throw_no_overlap();
    covered_ = found.share;
    if (raster_.crs_wkt.empty() && !info_.crs_wkt.empty())
        warnings_.add("The " + name_ + " has no coordinate reference system; its coordinates are taken as " +
                      "those of " + dem_ + ".");
    if (!raster_.crs_wkt.empty() && info_.crs_wkt.empty())
        warnings_.add("The " + name_ + " has a coordinate reference system and " + dem_ +
                      " has none; coordinates of both are taken as the same.");
    offset_ = whole_cell_offset(transform, info_);
    used_ = covering_cells(transform, info_.window, raster_);
    if (!offset_)
        warper_ = std::make_unique<ValueWarper>(reader_, raster_, info_, std::move(transform), resampling,
                                                warnings_);
}

UndeclaredNodata AlignedRaster::find_undeclared(double step, const ElevationLimits& limits) {
    if (used_.points() == 0)
        return {};
    const ReadValues read = [&](const Window& part, std::span<double> values) {
        reader_.read_part(part, values, warnings_);
        for (double& value : values)
            value = limits.hold(value) ? value : std::numeric_limits<double>::quiet_NaN();
    };
    return find_undeclared_nodata(used_, read_border(used_, read), {step, 0}, read);
}

void AlignedRaster::throw_no_overlap() const {
    std::string advice =
        "; give one of the same area, or correct a coordinate reference system that is wrong.";
    if (raster_.crs_wkt.empty() && !info_.crs_wkt.empty())
        advice =
            " in the coordinates of the latter, and it has no coordinate reference system; give it its own " +
            std::string("with gdal_edit.py -a_srs.");
    if (!raster_.crs_wkt.empty() && info_.crs_wkt.empty())
        advice =
            " in the coordinates of the former, and the DEM has no coordinate reference system; give it " +
            std::string("with -a_srs.");
    throw InputError("The " + name_ + " has no cell in the part of " + dem_ + " that is used" + advice);
}

void AlignedRaster::warn_about_gaps(const std::string& consequence) const {
    if (covered_ < 1)
        warnings_.add(percent_text(1 - covered_) + " of " + dem_ + " lies outside of the " + name_ + "; " +
                      consequence + " there.");
}

void AlignedRaster::read(const Window& part, std::span<double> values) {
    require_part(info_, part, values.size());
    if (offset_)
        copy(part, values);
    else
        warper_->read(part, values);
}

void AlignedRaster::copy(const Window& part, std::span<double> values) {
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
    // Part in cells of the raster, clipped to the raster.
    const std::int32_t top = part.row + offset_->rows;
    const std::int32_t left = part.col + offset_->cols;
    Window here{std::max(top, 0), std::max(left, 0), 0, 0};
    here.rows = std::min(top + part.rows, raster_.rows) - here.row;
    here.cols = std::min(left + part.cols, raster_.cols) - here.col;
    if (here.rows <= 0 || here.cols <= 0)
        return;
    part_.resize(static_cast<std::size_t>(here.points()));
    reader_.read_part(here, part_, warnings_);
    for (std::int32_t i = 0; i < here.rows; ++i)
        std::copy_n(part_.data() + std::ptrdiff_t{i} * here.cols, here.cols,
                    values.data() + std::ptrdiff_t{here.row - top + i} * part.cols + (here.col - left));
}

void TerrainSource::report_undeclared() {
    const ValueCounts& undeclared = raster_.counts().undeclared;
    for (const double value : excluded_)
        if (const std::int64_t cells = undeclared.cells_of(value).value_or(0); cells > 0)
            warnings().add(undeclared_text({value, cells}, "the " + raster_.name()) +
                           ", so they are treated as no data; " + raster_.declaration_advice(value) +
                           ", or keep the elevation with -inodata.");
}

void TerrainSource::report_shared() {
    const std::int64_t within = raster_.counts().within;
    for (const auto& [value, cells] : raster_.counts().bins->shared(within))
        if (2 * cells <= within && std::ranges::find(named_, value, &SharedValue::value) == named_.end())
            warnings().add(isolated_text({value, cells}, "the " + raster_.name()) +
                           "; if it stands for no data, " + raster_.declaration_advice(value) + ".");
}

void TerrainSource::detect_undeclared() {
    const UndeclaredNodata found =
        raster_.find_undeclared(UndeclaredNodataRules::step_m / (factor_ * dem_metres_), limits_);
    excluded_ = found.values();
    raster_.exclude(excluded_);
    named_ = found.named;
    for (const SharedValue& named : named_)
        warnings().add(undeclared_text(named, "the " + raster_.name()) + "; if it stands for no data, " +
                       raster_.declaration_advice(named.value) + ", and if not, give -inodata.");
}

std::unique_ptr<DemSource> open_terrain(const AuxiliaryRaster& raster, const DemInfo& grid,
                                        double dem_vertical_metres, const ElevationLimits& limits,
                                        const Callbacks& callbacks, const TerrainReadOptions& reading) {
    return std::make_unique<TerrainSource>(raster, grid, dem_vertical_metres, limits, reading,
                                           std::make_unique<Warnings>(callbacks.on_warning));
}

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

std::unique_ptr<DemSource> open_ndvi(const AuxiliaryRaster& raster, const DemInfo& grid,
                                     const Callbacks& callbacks) {
    return std::make_unique<NdviSource>(raster, grid, std::make_unique<Warnings>(callbacks.on_warning));
}

}  // namespace d2b::reading
