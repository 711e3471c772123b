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

/// The first band of any raster, on the grid and in the window of a DEM. Where the cells of both coincide,
/// values are those of the raster, bit by bit; else they are resampled. Half a cell of the raster inside its
/// edge values go on level.
class AlignedRaster {
  public:
    /// @param role what messages call the raster: "terrain"
    /// @throws InputError: cannot be opened, of no use as a raster, nothing in the window, only one of the
    /// two is georeferenced, no operation between the CRSs
    AlignedRaster(const std::string& role, const SideRaster& raster, const DemInfo& grid,
                  Resampling resampling, Warnings& warnings);

    /// "terrain 'dtm.tif'"
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Of the raster itself.
    [[nodiscard]] const DemInfo& raster() const { return raster_; }
    /// Of the DEM, by the name of the raster.
    [[nodiscard]] const DemInfo& info() const { return info_; }
    /// Warns where a part of the window lies outside of the raster. @param consequence "there is no ground"
    void warn_of_gaps(const std::string& consequence) const;

    /// Of the window.
    [[nodiscard]] double share_outside() const { return 1 - covered_; }

    /// As BandReader::take_only() and counts().
    void take_only(const ElevationLimits& limits) { reader_.take_only(limits); }
    [[nodiscard]] const LimitCounts& counts() const { return reader_.counts(); }
    /// From now on values that stand for no data without being declared are not valid. @param step, limits in
    /// the band's unit @throws InputError
    /// @return also those that stay
    UndeclaredValues take_undeclared_out(double step, const ElevationLimits& limits);
    [[nodiscard]] double stored(double value) const { return reader_.stored(value); }

    /// As DemSource::read(), in the band's unit, scale and offset applied. @throws InputError
    void read(const Window& part, std::span<double> values);

  private:
    void place(const DemInfo& grid, Resampling resampling);
    [[noreturn]] void refuse_elsewhere() const;
    void copy(const Window& part, std::span<double> values);

    Warnings& warnings_;
    std::string name_;
    std::string dem_;                                    ///< its name
    std::unique_ptr<KeptStandardInput> standard_input_;  // before the dataset, which must be closed first
    OpenRaster file_;
    DemInfo raster_;
    DemInfo info_;
    BandReader reader_;
    double covered_ = 0;
    Window used_;  ///< cells of the raster around the window of the DEM
    std::optional<CellOffset> offset_;
    std::unique_ptr<ValueWarper> warper_;  ///< where there is no offset
    std::vector<double> part_;
};

}  // namespace d2b
