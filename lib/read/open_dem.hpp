#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/open_raster.hpp"

namespace d2b::reading {

/// Source that owns its warnings, so that its members can refer to them.
class WarningSource : public DemSource {
  public:
    [[nodiscard]] std::vector<std::string> take_warnings() final { return warnings_->take(); }

  protected:
    explicit WarningSource(std::unique_ptr<Warnings> warnings) : warnings_(std::move(warnings)) {}

    [[nodiscard]] Warnings& warnings() { return *warnings_; }

  private:
    std::unique_ptr<Warnings> warnings_;
};

/// Copies an array into a raster in memory of GDAL, with NaN for values that are masked or not finite.
/// @param grid gives rows, columns, transform and plane CRS. The copy has no vertical CRS, so that elevations
/// are taken in the unit of the DEM
[[nodiscard]] OpenRaster array_raster(const ElevationArray& array, const DemInfo& grid);

}  // namespace d2b::reading
