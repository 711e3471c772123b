#include "read/open_dem.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/band_reader.hpp"
#include "read/cutline.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"
#include "read/georeferencing.hpp"
#include "read/shared_raster.hpp"
#include "read/source_place.hpp"

namespace d2b::reading {
namespace {

/// Applies the options to the NoData value of a band.
void override_nodata(GDALRasterBandH band, const ReadOptions& options, DemInfo& info) {
    const auto elevation_of = [&](double stored) { return stored * info.scale + info.offset; };
    int known = FALSE;
    const double declared = GDALGetRasterNoDataValue(band, &known);
    if (known != FALSE && (options.nodata || options.ignore_nodata) && declared != options.nodata)
        info.overridden_nodata = elevation_of(declared);
    if (options.nodata)
        info.nodata = elevation_of(*options.nodata);
    else if (options.ignore_nodata)
        info.nodata.reset();
}

bool holds_bytes(GDALRasterBandH band) {
    return GDALGetRasterDataType(band) == GDT_Byte && GDALGetRasterScale(band, nullptr) == 1 &&
           GDALGetRasterOffset(band, nullptr) == 0;
}

/// Returns "2024-05-31" from "2024:05:31 12:00:00" or "2024-05-31T12:00:00Z"; "" if the text does not begin
/// with a date.
std::string iso_date(const char* text) {
    constexpr std::string_view form = "0000-00-00";
    std::string date(text == nullptr ? "" : std::string_view(text).substr(0, form.size()));
    std::ranges::replace(date, ':', '-');
    for (std::size_t i = 0; i < form.size(); ++i)
        if (i >= date.size() || (form[i] == '0' ? date[i] < '0' || date[i] > '9' : date[i] != form[i]))
            return "";
    return date;
}

/// Returns the date of acquisition if the format stores it, otherwise that of the file's tag.
std::string date_of(GDALDatasetH dataset) {
    const std::string acquired = iso_date(GDALGetMetadataItem(dataset, "ACQUISITIONDATETIME", "IMAGERY"));
    return acquired.empty() ? iso_date(GDALGetMetadataItem(dataset, "TIFFTAG_DATETIME", nullptr)) : acquired;
}

DemInfo describe(const OpenRaster& raster, const SourcePlace& place, const ReadOptions& options,
                 Warnings& warnings) {
    const GdalMessages messages(GDALGetDescription(raster.dataset.get()), place.name());
    DemInfo info = describe_raster(raster, place.name());
    info.date = date_of(raster.dataset.get());
    override_nodata(raster.band, options, info);
    info.bands = GDALGetRasterCount(raster.dataset.get());
    info.bytes = holds_bytes(raster.band);
    read_transform(raster.dataset.get(), info, warnings);
    read_crs(raster.dataset.get(), options.crs, info, warnings);
    info.window = choose_window(options, info);
    if (const std::string order_warning = extent_order_warning(options, info); !order_warning.empty())
        warnings.add(order_warning);
    int block_cols = 0;
    GDALGetBlockSize(raster.band, &block_cols, &info.block_rows);
    info.block_rows = std::clamp(info.block_rows, 1, std::max(info.rows, 1));
    messages.pass_all(warnings);
    return info;
}

class GdalDemSource final : public WarningSource {
  public:
    GdalDemSource(std::unique_ptr<SourcePlace> place, OpenRaster raster, const ReadOptions& options,
                  std::unique_ptr<Warnings> own)
        : WarningSource(std::move(own)),
          place_(std::move(place)),
          info_(describe(raster, *place_, options, warnings())),
          readers_(make_concurrent(std::move(raster), options, place_->path(), info_, warnings())),
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
    std::unique_ptr<SourcePlace> place_;  // first, as the readers must be closed before it
    DemInfo info_;
    std::unique_ptr<ConcurrentRaster> readers_;
    std::unique_ptr<CutlineMask> cutline_;
};

const std::byte* at(const StridedValues& values, std::int32_t row, std::int32_t col) {
    return static_cast<const std::byte*>(values.first) + row * values.row_step + col * values.col_step;
}

template <typename Value>
void read_as(const StridedValues& values, const Window& part, double* elevations) {
    for (std::int32_t row = part.row; row < part.row + part.rows; ++row) {
        const std::byte* cell = at(values, row, part.col);
        for (std::int32_t col = 0; col < part.cols; ++col, cell += values.col_step) {
            Value value{};
            std::memcpy(&value, cell, sizeof(Value));
            *elevations++ = static_cast<double>(value);
        }
    }
}

void read_values(const ElevationArray& array, const Window& part, double* elevations) {
    switch (array.type) {
        case ValueType::int8:
            return read_as<std::int8_t>(array.values, part, elevations);
        case ValueType::uint8:
            return read_as<std::uint8_t>(array.values, part, elevations);
        case ValueType::int16:
            return read_as<std::int16_t>(array.values, part, elevations);
        case ValueType::uint16:
            return read_as<std::uint16_t>(array.values, part, elevations);
        case ValueType::int32:
            return read_as<std::int32_t>(array.values, part, elevations);
        case ValueType::uint32:
            return read_as<std::uint32_t>(array.values, part, elevations);
        case ValueType::int64:
            return read_as<std::int64_t>(array.values, part, elevations);
        case ValueType::uint64:
            return read_as<std::uint64_t>(array.values, part, elevations);
        case ValueType::float32:
            return read_as<float>(array.values, part, elevations);
        case ValueType::float64:
            return read_as<double>(array.values, part, elevations);
    }
}

void require_array_options(const ReadOptions& options, const std::string& name) {
    const std::string given = options.band != 1               ? "-b"
                              : !options.open_options.empty() ? "-oo"
                              : !options.drivers.empty()      ? "-if"
                                                              : "";
    if (!given.empty())
        throw OptionError(given + " is for files and has no effect on '" + name + "'; leave it out.");
}

DemInfo describe(const ElevationArray& array, const ReadOptions& options, Warnings& warnings) {
    DemInfo info;
    info.name = array.name;
    info.rows = array.rows;
    info.cols = array.cols;
    info.driver = "array";
    info.bytes = array.type == ValueType::uint8;
    set_transform(array.transform, "correct it", info, warnings);
    set_crs("", options.crs, info, warnings);
    info.window = choose_window(options, info);
    if (const std::string order_warning = extent_order_warning(options, info); !order_warning.empty())
        warnings.add(order_warning);
    return info;
}

/// Reads a part, with NaN for values that are masked or not finite.
void read_valid(const ElevationArray& array, const Window& part, std::span<double> values) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    read_values(array, part, values.data());
    for (double& value : values)
        if (!std::isfinite(value))
            value = none;
    if (array.masked.first == nullptr)
        return;
    double* value = values.data();
    for (std::int32_t row = part.row; row < part.row + part.rows; ++row)
        for (std::int32_t col = part.col; col < part.col + part.cols; ++col, ++value)
            if (*at(array.masked, row, col) != std::byte{0})
                *value = none;
}

class ArrayDemSource final : public DemSource {
  public:
    ArrayDemSource(const ElevationArray& array, const ReadOptions& options, Warnings& warnings)
        : array_(array),
          info_(describe(array, options, warnings)),
          cutline_(open_cutline(options, info_, warnings)) {
        if (options.nodata)
            nodata_ = array.type == ValueType::float32 ? round_to_single(*options.nodata) : *options.nodata;
    }

    [[nodiscard]] const DemInfo& info() const override { return info_; }

    void read(const Window& part, std::span<double> elevations) override {
        require_part(info_, part, elevations.size());
        read_valid(array_, part, elevations);
        if (nodata_)
            std::ranges::replace(elevations, *nodata_, std::numeric_limits<double>::quiet_NaN());
        if (cutline_)
            cutline_->apply(part, elevations);
    }

  private:
    ElevationArray array_;
    DemInfo info_;
    std::unique_ptr<CutlineMask> cutline_;
    std::optional<double> nodata_;
};

/// Creates a raster in memory. @throws InputError if memory does not suffice
DatasetOwner empty_raster(const DemInfo& grid, GDALDataType type) {
    const GdalMessages messages;
    DatasetOwner dataset(GDALCreate(GDALGetDriverByName("MEM"), "", grid.cols, grid.rows, 1, type, nullptr));
    if (!dataset)
        throw InputError("There is no room for a copy of an array of " + std::to_string(grid.rows) +
                         " rows and " + std::to_string(grid.cols) + " columns (" + messages.reason() +
                         "); use a part of it.");
    return dataset;
}

}  // namespace

OpenRaster array_raster(const ElevationArray& array, const DemInfo& grid) {
    const bool exact_in_single = array.type == ValueType::float32 || array.type == ValueType::int8 ||
                                 array.type == ValueType::uint8 || array.type == ValueType::int16 ||
                                 array.type == ValueType::uint16;
    OpenRaster raster{empty_raster(grid, exact_in_single ? GDT_Float32 : GDT_Float64), nullptr};
    const GdalMessages quiet;
    if (AffineTransform transform = grid.transform; grid.georeferenced)
        GDALSetGeoTransform(raster.dataset.get(), transform.data());
    if (const CrsOwner crs = horizontal_crs(grid.crs_wkt))
        GDALSetSpatialRef(raster.dataset.get(), crs.get());
    raster.band = GDALGetRasterBand(raster.dataset.get(), 1);
    GDALSetRasterNoDataValue(raster.band, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> row(static_cast<std::size_t>(grid.cols));
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        read_valid(array, {i, 0, 1, grid.cols}, row);
        if (GDALRasterIO(raster.band, GF_Write, 0, i, grid.cols, 1, row.data(), grid.cols, 1, GDT_Float64, 0,
                         0) != CE_None)
            throw InputError("'" + array.name + "' cannot be copied: " + quiet.reason() + ".");
    }
    return raster;
}

}  // namespace d2b::reading

namespace d2b {

std::unique_ptr<DemSource> open_dem(const ReadOptions& options, const Callbacks& callbacks) {
    reading::register_formats();
    auto warnings = std::make_unique<Warnings>(callbacks.on_warning);
    auto place = std::make_unique<reading::SourcePlace>(options);
    ReadOptions named = options;
    named.source = place->name();
    reading::OpenRaster raster = reading::open_raster(named, place->path(), *warnings);
    return std::make_unique<reading::GdalDemSource>(std::move(place), std::move(raster), named,
                                                    std::move(warnings));
}

std::unique_ptr<DemSource> open_dem(const ElevationArray& array, const ReadOptions& options,
                                    const Callbacks& callbacks) {
    if (array.rows < 1 || array.cols < 1)
        throw InputError("'" + array.name + "' has no cells; give at least one row and one column.");
    reading::register_formats();
    reading::require_array_options(options, array.name);
    Warnings warnings(callbacks.on_warning);
    return std::make_unique<reading::ArrayDemSource>(array, options, warnings);
}

}  // namespace d2b
