#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/invalid_elevations.hpp"
#include "core/undeclared_nodata.hpp"
#include "core/warnings.hpp"
#include "read/band_reader.hpp"
#include "read/open_raster.hpp"
#include "read/resampling.hpp"
#include "read/side_rasters.hpp"
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
    /// Finds the margin that was blended with missing cells. @param undeclared values that stand for NoData
    /// @param step, limits in the unit of the band @throws InputError
    [[nodiscard]] BlendedMargin find_blended(const std::vector<double>& undeclared, double step,
                                             const ElevationLimits& limits);
    /// Warns of cells in the margin that were read. @param margin of this raster
    void warn_about_blended(const BlendedMargin& margin) const;
    /// Number of cells of the raster that cover the window of the DEM.
    [[nodiscard]] std::int64_t used_cells() const { return used_.points(); }
    /// Same as BandReader::exclude().
    void exclude(std::vector<double> undeclared, BlendedMargin margin) {
        reader_.exclude(std::move(undeclared), std::move(margin));
    }
    /// Returns the advice for a value that stands for no data: "declare that with gdal_edit.py -a_nodata 0".
    [[nodiscard]] std::string declaration_advice(double value) const;

    /// Same as DemSource::read(), in the unit of the band, with scale and offset applied. @throws InputError
    void read(const Window& part, std::span<double> values);

  private:
    void place(const DemInfo& grid, Resampling resampling);
    [[noreturn]] void throw_no_overlap() const;
    void copy(const Window& part, std::span<double> values);
    /// Value before scale and offset were applied.
    [[nodiscard]] double stored(double value) const {
        return stored_value(value, raster_.scale, raster_.offset);
    }

    Warnings& warnings_;
    std::string name_;
    bool is_array_;
    std::string dem_;                                ///< name of the DEM, for messages
    std::unique_ptr<TemporaryFile> standard_input_;  // first, as the dataset must be closed before it
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

/// Returns a share at the beginning of a sentence: "About 12 %", "Less than 1 %".
[[nodiscard]] std::string percent_text(double share);

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

}  // namespace d2b::reading
