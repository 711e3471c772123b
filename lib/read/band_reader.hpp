#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/undeclared_nodata.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

/// Cells of a raster that have been visited, as ranges of columns per row. Ranges of adjacent or overlapping
/// parts are merged, so that few remain.
class RowCoverage {
  public:
    explicit RowCoverage(std::int32_t rows) : rows_(static_cast<std::size_t>(rows)) {}

    /// Visits columns [begin, end) of a row: calls use(begin, end) for each range of them that was not
    /// visited before.
    void add(std::int32_t row, std::int32_t begin, std::int32_t end,
             const std::function<void(std::int32_t, std::int32_t)>& use);

  private:
    using ColumnRange = std::pair<std::int32_t, std::int32_t>;  ///< half-open
    std::vector<std::vector<ColumnRange>> rows_;                ///< ascending and disjoint
};

/// Counts of cells with values within and outside of limits.
struct LimitCounts {
    std::int64_t within = 0;
    ValueCounts outside;
    ValueCounts undeclared;         ///< values that stand for NoData, see UndeclaredNodata
    std::int64_t blended = 0;       ///< cells in a BlendedMargin
    std::optional<ValueBins> bins;  ///< values within the limits
};

/// NoData value as a band of 32-bit floats would hold it. Decimal texts of the largest float may lie a little
/// above it and are rounded to it; values farther out equal no float.
[[nodiscard]] double round_to_single(double value);

/// Reads elevations of one band: applies scale and offset, and returns NaN for values that are not valid.
/// A value is valid if it is finite and neither the mask of the band (NoData, mask of the dataset) nor an
/// alpha band of any type rules it out (0 is invalid, any other alpha is valid). options.nodata replaces the
/// NoData value of the file and is compared with stored values; options.ignore_nodata disables all masks.
class BandReader {
  public:
    /// @param band its dataset must outlive the reader @param info its description, see describe_raster()
    /// @throws OptionError if both nodata and ignore_nodata are given. @throws InputError if the scale is
    /// zero or not finite
    BandReader(GDALRasterBandH band, const ReadOptions& options, DemInfo info, Warnings& warnings);

    /// Rejects values outside of `limits` from now on, and counts them. @param metres per unit of the values
    void restrict_to(const ElevationLimits& limits, double metres);
    /// Also rejects `undeclared` values and cells in a margin from now on and restarts the counts. @pre
    /// restrict_to()
    void exclude(std::vector<double> undeclared, BlendedMargin margin);
    /// Counts of all cells read so far. Each cell is counted once.
    [[nodiscard]] const LimitCounts& counts() const { return counts_; }

    /// Reads part of the window, a few rows at a time. @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void read(const Window& part, std::span<double> elevations, Warnings& warnings);
    /// Reads any part of the raster in one call. @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void read_part(const Window& part, std::span<double> elevations, Warnings& warnings);
    /// Same, but neither rejects nor counts values. @throws InputError with GDAL's reason
    void read_unchecked(const Window& part, std::span<double> elevations, Warnings& warnings);
    /// Releases the decoded blocks in GDAL's cache.
    void drop_cached_blocks() const;

  private:
    void restart_counts();
    void exclude(const Window& part, std::span<double> elevations);
    void count(double value);
    [[nodiscard]] bool is_scaled() const { return info_.scale != 1 || info_.offset != 0; }
    void to_elevations(std::span<double> values, bool masked) const;
    /// Sets cells with alpha 0 to NaN.
    void mask_transparent(const Window& part, std::span<double> values, Warnings& warnings);
    void load(GDALRasterBandH band, GDALDataType type, const Window& part, void* values,
              Warnings& warnings) const;
    [[nodiscard]] std::int32_t chunk_rows() const;

    GDALRasterBandH band_;
    GDALRasterBandH alpha_ = nullptr;  ///< alpha band of the dataset; null if there is none or it is ignored
    DemInfo info_;
    bool masked_ = false;
    std::optional<double> mask_nodata_;  ///< value of masked cells; nothing if they may have any value
    bool single_precision_ = false;
    std::optional<double> nodata_;  ///< set if it replaces the file's
    std::vector<std::uint8_t> mask_;
    std::vector<double> alpha_values_;
    ElevationLimits limits_;
    double metres_ = 1;  ///< per unit of the values
    std::vector<double> undeclared_;
    BlendedMargin margin_;
    LimitCounts counts_;
    std::optional<RowCoverage> coverage_;  ///< not set if nothing is counted
};

}  // namespace d2b::reading
