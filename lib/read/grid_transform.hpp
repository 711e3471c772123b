#pragma once

#include <span>
#include <string>

#include <gdal_alg.h>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

using TransformerOwner = GdalOwner<void*, GDALDestroyTransformer>;

/// Transforms between pixel coordinates of the DEM's grid and those of another raster: x is columns, y is
/// rows (downwards), (0, 0) the outer corner of the first cell. Heights are ignored. If one of the two has no
/// CRS, it is taken to be in the other's.
class GridTransform {
  public:
    /// @param name of the raster, for messages: "terrain 'dtm.tif'"
    /// @throws InputError if there is no operation between the two CRSs
    GridTransform(const std::string& name, const DemInfo& raster, const DemInfo& grid);

    /// Transforms in place; NaN if a position has no image.
    void to_raster(std::span<Position> positions) const { apply(positions, true); }
    void to_grid(std::span<Position> positions) const { apply(positions, false); }

    /// Returns true if both use the same coordinates.
    [[nodiscard]] bool same_crs() const { return same_crs_; }
    /// Argument of GDALGenImgProjTransform(), with the raster as its source.
    [[nodiscard]] void* handle() const { return transformer_.get(); }

  private:
    void apply(std::span<Position> positions, bool to_raster) const;

    TransformerOwner transformer_;
    bool same_crs_ = true;
};

}  // namespace d2b
