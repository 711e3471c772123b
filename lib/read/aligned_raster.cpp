#include "read/aligned_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "raster/blended_margin.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/open_dem.hpp"

namespace d2b::reading {
namespace {

DemInfo describe(const OpenRaster& file, const std::string& path, Warnings& warnings) {
    const GdalMessages messages;
    DemInfo info = describe_raster(file, path);
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
    std::vector<Position> edge = edge_of(window, steps);
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

}  // namespace

std::string percent_text(double share) {
    if (share < 0.01)
        return "Less than 1 %";
    if (share > 0.99)
        return "More than 99 %";
    return "About " + std::to_string(static_cast<int>(std::lround(share * 100))) + " %";
}

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

BlendedMargin AlignedRaster::find_blended(const std::vector<double>& undeclared, double step,
                                          const ElevationLimits& limits) {
    if (used_.points() == 0)
        return {};
    return find_blended_margin(used_, {raster_.nodata, undeclared, limits}, step,
                               [&](const Window& part, std::span<double> values) {
                                   reader_.read_unchecked(part, values, warnings_);
                               });
}

void AlignedRaster::warn_about_blended(const BlendedMargin& margin) const {
    if (const std::int64_t cells = counts().blended; cells > 0)
        warnings_.add(
            blended_text(cells, margin, "the " + name_, margin.with ? value_text(stored(*margin.with)) : ""));
}

std::string AlignedRaster::declaration_advice(double value) const {
    if (is_array_)
        return "set these cells to NaN";
    int known = FALSE;
    const double nodata = GDALGetRasterNoDataValue(file_.band, &known);
    const double as_stored = stored(value);
    return known != FALSE && std::isfinite(nodata) && nodata != as_stored
               ? second_nodata_advice(as_stored, nodata)
               : "declare that with gdal_edit.py -a_nodata " + value_text(as_stored);
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

}  // namespace d2b::reading
