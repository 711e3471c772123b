#include "read/band_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <cpl_conv.h>

#include "core/grid.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "raster/blended_margin.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"
#include "read/source_files.hpp"

namespace d2b::reading {

void RowCoverage::add(std::int32_t row, std::int32_t begin, std::int32_t end,
                      const std::function<void(std::int32_t, std::int32_t)>& use) {
    std::vector<ColumnRange>& visited = rows_[static_cast<std::size_t>(row)];
    // Merges the new range with all that it overlaps or touches.
    const auto first = std::ranges::lower_bound(visited, begin, {}, &ColumnRange::second);
    const auto last = std::ranges::upper_bound(visited, end, {}, &ColumnRange::first);
    ColumnRange whole{begin, end};
    std::int32_t next = begin;
    for (auto run = first; run < last; ++run) {
        if (next < run->first)
            use(next, run->first);
        next = std::max(next, run->second);
        whole = {std::min(whole.first, run->first), std::max(whole.second, run->second)};
    }
    if (next < end)
        use(next, end);
    if (begin < end)
        visited.insert(visited.erase(first, last), whole);
}

namespace {

/// Name of the opened dataset. Standard input has a temporary file that users do not know.
std::string path_of(GDALRasterBandH band) {
    const GDALDatasetH dataset = GDALGetBandDataset(band);
    return dataset == nullptr ? "" : GDALGetDescription(dataset);
}

/// Returns the first alpha band of the dataset other than `band`, or null.
GDALRasterBandH find_alpha_band(GDALRasterBandH band) {
    const GDALDatasetH dataset = GDALGetBandDataset(band);
    const int bands = dataset == nullptr ? 0 : GDALGetRasterCount(dataset);
    for (int i = 1; i <= bands; ++i)
        if (GDALRasterBandH other = GDALGetRasterBand(dataset, i);
            other != band && GDALGetRasterColorInterpretation(other) == GCI_AlphaBand)
            return other;
    return nullptr;
}

/// Returns the NoData value of a floating-point band if its mask is derived from NoData alone.
std::optional<double> masked_value(GDALRasterBandH band) {
    const GDALDataType type = GDALGetRasterDataType(band);
    int known = FALSE;
    const double nodata = GDALGetRasterNoDataValue(band, &known);
    if (known == FALSE || GDALGetMaskFlags(band) != GMF_NODATA ||
        (type != GDT_Float32 && type != GDT_Float64) ||
        !(std::abs(nodata) <= static_cast<double>(std::numeric_limits<float>::max())))
        return {};
    return type == GDT_Float32 ? round_to_single(nodata) : nodata;
}

/// Sets NoData and values that are not finite to NaN. @return number of values near NoData that do not equal
/// it
D2B_MULTIVERSION std::size_t replace_nodata(std::span<double> values, double nodata) {
    constexpr double near = 1e-5;  // relative; GDAL treats about 1e-6 as equal
    constexpr double largest = std::numeric_limits<double>::max();
    constexpr double invalid = std::numeric_limits<double>::quiet_NaN();
    const double distance = std::abs(nodata) * near;
    std::size_t unclear = 0;
    for (double& value : values) {
        const double z = value;
        const bool other = z != nodata;
        unclear += (std::abs(z - nodata) <= distance ? 1U : 0U) & (other ? 1U : 0U);
        value = (other ? 1 : 0) & (std::abs(z) <= largest ? 1 : 0) ? z : invalid;
    }
    return unclear;
}

}  // namespace

double round_to_single(double value) {
    constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
    if (std::isfinite(value) && std::abs(value) > largest)
        return std::abs(value) <= 3.4028236e38 ? std::copysign(largest, value) : value;
    return static_cast<double>(static_cast<float>(value));
}

BandReader::BandReader(GDALRasterBandH band, const ReadOptions& options, DemInfo info, Warnings& warnings)
    : band_(band), info_(std::move(info)) {
    const GdalMessages messages(path_of(band_), info_.name);
    const NetworkGuard gate(GDALGetBandDataset(band_));
    if (options.nodata && options.ignore_nodata)
        throw OptionError("-snodata and -inodata exclude each other; give only one of them.");
    if (!std::isfinite(info_.scale) || !std::isfinite(info_.offset) || info_.scale == 0)
        throw InputError(
            "'" + info_.name + "' has the scale " + number_text(info_.scale) + " and the offset " +
            number_text(info_.offset) +
            ", which give no elevations; correct them, for example with gdal_edit.py -scale -offset.");
    const int flags = GDALGetMaskFlags(band_);
    const bool replaced = options.nodata && (flags & GMF_NODATA) != 0;
    // GDAL derives a mask only from alpha bands of bytes and divides 16-bit alpha by 257.
    alpha_ = options.ignore_nodata ? nullptr : find_alpha_band(band_);
    const bool is_alpha = alpha_ != nullptr && (flags & GMF_ALPHA) != 0;
    masked_ = !options.ignore_nodata && !replaced && !is_alpha && (flags & GMF_ALL_VALID) == 0;
    single_precision_ = GDALGetRasterDataType(band_) == GDT_Float32;
    mask_nodata_ = masked_value(band_);
    if (options.nodata)
        nodata_ = single_precision_ ? round_to_single(*options.nodata) : *options.nodata;
    messages.pass_all(warnings);
}

std::int32_t BandReader::chunk_rows() const {
    constexpr std::int64_t most_cells = std::int64_t{1} << 22;
    int block_cols = 0;
    int block_rows = 0;
    GDALGetBlockSize(band_, &block_cols, &block_rows);
    block_rows = std::clamp(block_rows, 1, info_.rows);
    const std::int64_t fit = most_cells / info_.cols / block_rows;
    return static_cast<std::int32_t>(
        std::min<std::int64_t>(std::max<std::int64_t>(1, fit) * block_rows, info_.rows));
}

void BandReader::read(const Window& part, std::span<double> elevations, Warnings& warnings) {
    const auto cols = static_cast<std::size_t>(part.cols);
    require_part(info_, part, elevations.size());
    // Reads whole rows of blocks, because GDAL's NoData mask then reads the same blocks from its cache.
    const std::int32_t step = chunk_rows();
    const std::int32_t end = part.end_row();
    for (std::int32_t row = part.row; row < end;) {
        const std::int32_t next = std::min<std::int32_t>(end - row, step - row % step) + row;
        const std::size_t at = static_cast<std::size_t>(row - part.row) * cols;
        read_part({row, part.col, next - row, part.cols},
                  elevations.subspan(at, static_cast<std::size_t>(next - row) * cols), warnings);
        row = next;
    }
}

void BandReader::drop_cached_blocks() const {
    static_cast<void>(GDALFlushRasterCache(band_));  // errors are ignored because the dataset is read-only
}

void BandReader::read_part(const Window& part, std::span<double> elevations, Warnings& warnings) {
    read_without_margin(
        margin_, {0, 0, info_.rows, info_.cols}, part, elevations,
        [&](const Window& area, std::span<double> values) { read_unchecked(area, values, warnings); });
    if (coverage_)
        exclude(part, elevations);
}

void BandReader::read_unchecked(const Window& part, std::span<double> elevations, Warnings& warnings) {
    load(band_, GDT_Float64, part, elevations.data(), warnings);
    // Values equal to NoData are masked and values far from it are not. Only if there are values in between
    // is GDAL's mask asked, because it reads all values once more.
    const bool mask_is_known = masked_ && mask_nodata_ && replace_nodata(elevations, *mask_nodata_) == 0;
    const bool needs_mask = masked_ && !mask_is_known;
    if (needs_mask) {
        mask_.resize(elevations.size());
        load(GDALGetMaskBand(band_), GDT_Byte, part, mask_.data(), warnings);
    }
    if (!mask_is_known || is_scaled())
        to_elevations(elevations, needs_mask);
    if (alpha_ != nullptr)
        mask_transparent(part, elevations, warnings);
}

/// @param masked true if mask_ decides which values are valid
void BandReader::to_elevations(std::span<double> values, bool masked) const {
    constexpr double invalid = std::numeric_limits<double>::quiet_NaN();
    const bool scaled = is_scaled();
    if (!masked && !scaled) {
        const double none = nodata_.value_or(invalid);  // equals no value
        for (double& value : values)
            value = value != none && std::isfinite(value) ? value : invalid;
        return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        double& value = values[i];
        if ((masked && mask_[i] == 0) || (nodata_ && value == *nodata_))
            value = invalid;
        else if (scaled)
            value = value * info_.scale + info_.offset;
        if (!std::isfinite(value))
            value = invalid;
    }
}

void BandReader::mask_transparent(const Window& part, std::span<double> values, Warnings& warnings) {
    alpha_values_.resize(values.size());
    load(alpha_, GDT_Float64, part, alpha_values_.data(), warnings);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (alpha_values_[i] == 0)
            values[i] = std::numeric_limits<double>::quiet_NaN();
}

void BandReader::restrict_to(const ElevationLimits& limits, double metres) {
    limits_ = limits;
    metres_ = metres;
    restart_counts();
}

void BandReader::exclude(std::vector<double> undeclared, BlendedMargin margin) {
    undeclared_ = std::move(undeclared);
    margin_ = std::move(margin);
    restart_counts();
}

void BandReader::restart_counts() {
    counts_ = {};
    counts_.bins.emplace(limits_, metres_);
    coverage_.emplace(info_.rows);
}

void BandReader::exclude(const Window& part, std::span<double> elevations) {
    const auto cols = static_cast<std::size_t>(part.cols);
    for (std::int32_t i = 0; i < part.rows; ++i) {
        const std::span<double> row = elevations.subspan(static_cast<std::size_t>(i) * cols, cols);
        coverage_->add(part.row + i, part.col, part.end_col(), [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t col = begin; col < end; ++col)
                count(row[static_cast<std::size_t>(col - part.col)]);
        });
        for (double& value : row)
            if (!limits_.hold(value) || std::ranges::find(undeclared_, value) != undeclared_.end())
                value = std::numeric_limits<double>::quiet_NaN();
    }
}

void BandReader::count(double value) {
    if (std::ranges::find(undeclared_, value) != undeclared_.end()) {
        counts_.undeclared.add(value);
    } else if (limits_.hold(value)) {
        ++counts_.within;
        counts_.bins->add(value, 1);
    } else if (value == blended_value) {
        ++counts_.blended;
    } else if (!std::isnan(value)) {
        counts_.outside.add(value);
    }
}

void BandReader::load(GDALRasterBandH band, GDALDataType type, const Window& part, void* values,
                      Warnings& warnings) const {
    const std::string path = path_of(band_);
    const GdalMessages messages(path, info_.name);
    const NetworkGuard gate(GDALGetBandDataset(band_));
    // Disables GDAL's single read of uncompressed files, because it fills unreadable parts with zeros.
    const CPLConfigOptionSetter no_big_reads("GDAL_ONE_BIG_READ", "NO", false);
    const CPLErr status = GDALRasterIOEx(band, GF_Read, part.col, part.row, part.cols, part.rows, values,
                                         part.cols, part.rows, type, 0, 0, nullptr);
    if (status != CE_None || messages.failed())
        throw InputError("Rows " + std::to_string(part.row) + " to " +
                         std::to_string(part.row + part.rows - 1) + " of '" + info_.name +
                         "' cannot be read: " + messages.reason() + read_failure_advice(path, info_.driver) +
                         ".");
    messages.pass_warnings(warnings);
}

}  // namespace d2b::reading
