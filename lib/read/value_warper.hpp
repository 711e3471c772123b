#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gdalwarper.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/band_reader.hpp"
#include "read/grid_transform.hpp"
#include "read/value_dataset.hpp"

namespace d2b {

enum class Resampling {
    nearest,   ///< value of the cell that contains a centre
    bilinear,  ///< between cell centres; for finer rasters, a mean weighted by distance
};

/// Resamples a band to the grid of a DEM with GDAL's warper, one part at a time.
class ValueWarper {
  public:
    /// @param reader of the band @param raster its grid. The reader and the warnings must outlive this object
    /// @throws InputError with GDAL's reason
    ValueWarper(BandReader& reader, const DemInfo& raster, const DemInfo& grid, GridTransform transform,
                Resampling resampling, Warnings& warnings);
    ValueWarper(const ValueWarper&) = delete;
    ValueWarper& operator=(const ValueWarper&) = delete;
    ~ValueWarper();

    /// @param wanted cells of the DEM @param values one per cell, NaN if the raster has none
    /// @throws InputError
    void read(const Window& wanted, std::span<double> values);

  private:
    using OperationOwner = GdalOwner<GDALWarpOperationH, GDALDestroyWarpOperation>;

    [[nodiscard]] OperationOwner make_operation(Resampling resampling, double most_error);
    /// Returns true if no point of a part's edge has an image, because GDAL treats that as an error.
    [[nodiscard]] bool elsewhere(const Window& part) const;
    void warp(const Window& part);

    std::string name_;
    GridTransform transform_;
    std::array<double, 2> cell_;  ///< size of a DEM cell in columns and rows of the raster
    /// Columns of a part. Parts begin at multiples of it in the whole DEM, because GDAL interpolates
    /// positions along their rows: windows and bands of the same DEM then get the same values.
    std::int32_t part_cols_;
    std::int32_t most_rows_;  ///< per part
    ValueSource source_;
    DatasetOwner dataset_;
    TransformerOwner approximate_;
    OperationOwner operation_;
    std::vector<double> part_;
};

}  // namespace d2b
