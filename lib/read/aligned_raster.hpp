#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/undeclared_values.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/band_reader.hpp"
#include "read/grid_fit.hpp"
#include "read/open_raster.hpp"
#include "read/side_rasters.hpp"
#include "read/standard_input.hpp"
#include "read/value_warper.hpp"

namespace d2b {

/// First band of a raster, read on the grid and in the window of a DEM. If cells of both coincide, values are
/// those of the raster bit by bit; otherwise they are resampled. Values continue level for half a cell beyond
/// the outermost cell centres of the raster.
class AlignedRaster {
  public:
    /// @param role name of the raster in messages: "terrain"
    /// @throws InputError: cannot be opened, not usable as a raster, no overlap with the window, only one of
    /// the two is georeferenced, no operation between the CRSs
    AlignedRaster(const std::string& role, const SideRaster& raster, const DemInfo& grid,
                  Resampling resampling, Warnings& warnings);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Description of the raster itself.
    [[nodiscard]] const DemInfo& raster() const { return raster_; }
    /// Description of the DEM, under the name of the raster.
    [[nodiscard]] const DemInfo& info() const { return info_; }
    /// Warns if part of the window lies outside of the raster. @param consequence "there is no ground"
    void warn_of_gaps(const std::string& consequence) const;

    /// Share of the window outside of the raster.
    [[nodiscard]] double share_outside() const { return 1 - covered_; }

    /// Same as BandReader::take_only() and counts().
    void take_only(const ElevationLimits& limits) { reader_.take_only(limits); }
    [[nodiscard]] const LimitCounts& counts() const { return reader_.counts(); }
    /// Rejects values that stand for NoData without being declared, from now on. @param step,
    /// limits in the unit of the band @throws InputError
    /// @return all undeclared values found, including those that are kept
    UndeclaredValues take_undeclared_out(double step, const ElevationLimits& limits);
    [[nodiscard]] double stored(double value) const { return reader_.stored(value); }

    /// Same as DemSource::read(), in the unit of the band, with scale and offset applied. @throws InputError
    void read(const Window& part, std::span<double> values);

  private:
    void place(const DemInfo& grid, Resampling resampling);
    [[noreturn]] void refuse_elsewhere() const;
    void copy(const Window& part, std::span<double> values);

    Warnings& warnings_;
    std::string name_;
    std::string dem_;                                    ///< name of the DEM, for messages
    std::unique_ptr<KeptStandardInput> standard_input_;  // first, as the dataset must be closed before it
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

}  // namespace d2b
