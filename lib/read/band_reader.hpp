#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/elevation_limits.hpp"
#include "core/value_counts.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "read/gdal_handles.hpp"
#include "read/seen_cells.hpp"

namespace d2b {

/// Cells that have values within and outside of limits.
struct LimitCounts {
    std::int64_t within = 0;
    ValueCounts outside;
    ValueCounts undeclared;  ///< values that stand for no data, see UndeclaredValues
};

/// A NoData value as a band of 32-bit floats would hold it. Decimal texts of the largest float may lie a
/// little above it; what is farther out equals no float.
[[nodiscard]] double as_single(double value);

/// Reads elevations of one band: scale and offset applied, NaN where a value is not valid.
/// Valid is what is finite and what the band's mask (NoData, mask of the dataset) and an alpha band of any
/// type let through, where 0 is invalid and any other value valid. options.nodata takes the place of the
/// file's NoData value and is compared with values as stored; options.ignore_nodata sets every mask aside.
class BandReader {
  public:
    /// @param band belongs to a dataset that must outlive the reader
    /// @throws OptionError both nodata and ignore_nodata. @throws InputError a scale that is zero or not
    /// finite
    BandReader(GDALRasterBandH band, const ReadOptions& options, DemInfo info, Warnings& warnings);

    /// From now on values outside of these are not valid, and are counted.
    void take_only(const ElevationLimits& limits);
    /// Nor are values that stand for no data from now on, and counts begin anew. @pre take_only()
    void take_out(std::vector<double> undeclared);
    /// What has been read so far of that, each cell once.
    [[nodiscard]] const LimitCounts& counts() const { return counts_; }
    /// Before scale and offset.
    [[nodiscard]] double stored(double value) const { return stored_value(value, scale_, offset_); }

    /// A part of the window, a few rows at a time. @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void read(const Window& part, std::span<double> elevations, Warnings& warnings);
    /// Any part of the raster, in one piece. @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void read_part(const Window& part, std::span<double> elevations, Warnings& warnings);
    /// Gives the memory of the blocks back that GDAL has decoded and keeps.
    void forget_blocks() const;

  private:
    void take_out(const Window& part, std::span<double> elevations);
    void count(double value);
    [[nodiscard]] bool is_scaled() const { return scale_ != 1 || offset_ != 0; }
    void make_elevations(std::span<double> values, bool masked) const;
    /// Makes NaN of what the alpha band has 0 for.
    void take_transparent_out(const Window& part, std::span<double> values, Warnings& warnings);
    void load(GDALRasterBandH band, GDALDataType type, const Window& part, void* values,
              Warnings& warnings) const;
    [[nodiscard]] std::int32_t chunk_rows() const;

    GDALRasterBandH band_;
    GDALRasterBandH alpha_ = nullptr;  ///< of the same dataset; null where there is none, or it is ignored
    DemInfo info_;
    double scale_ = 1;
    double offset_ = 0;
    bool masked_ = false;
    std::optional<double> mask_nodata_;  ///< what masked cells have; nothing where they may have any value
    bool single_precision_ = false;
    std::optional<double> nodata_;  ///< set where the user's own takes effect
    std::vector<std::uint8_t> mask_;
    std::vector<double> alpha_values_;
    ElevationLimits limits_;
    std::vector<double> undeclared_;
    LimitCounts counts_;
    std::optional<SeenCells> counted_;  ///< not set where nothing is counted
};

}  // namespace d2b
