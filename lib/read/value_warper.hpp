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
    nearest,   ///< the value of the cell in which a centre lies
    bilinear,  ///< between centres of cells; of finer rasters the mean around, weighted by distance
};

/// Brings a band onto the grid of a DEM with GDAL's warper, a part at a time.
class ValueWarper {
  public:
    /// @param reader of the band, @param raster where its cells are; the reader and the warnings must outlive
    /// this @throws InputError with GDAL's reason
    ValueWarper(BandReader& reader, const DemInfo& raster, const DemInfo& grid, GridTransform transform,
                Resampling resampling, Warnings& warnings);
    ValueWarper(const ValueWarper&) = delete;
    ValueWarper& operator=(const ValueWarper&) = delete;
    ~ValueWarper();

    /// @param wanted cells of the DEM @param values one a cell, NaN where the raster has none
    /// @throws InputError
    void read(const Window& wanted, std::span<double> values);

  private:
    using OperationOwner = GdalOwner<GDALWarpOperationH, GDALDestroyWarpOperation>;

    [[nodiscard]] OperationOwner make_operation(Resampling resampling, double most_error);
    /// Where no point of a part's edge has an image, which GDAL takes for an error.
    [[nodiscard]] bool elsewhere(const Window& part) const;
    void warp(const Window& part);

    std::string name_;
    GridTransform transform_;
    std::array<double, 2> cell_;  ///< of the DEM, in columns and rows of the raster
    /// Columns of a part. Parts begin at multiples of it in the whole DEM: GDAL interpolates positions along
    /// their rows, and so windows and bands of the same DEM get the same values.
    std::int32_t part_cols_;
    std::int32_t most_rows_;  ///< of a part
    ValueSource source_;
    DatasetOwner dataset_;
    TransformerOwner approximate_;
    OperationOwner operation_;
    std::vector<double> part_;
};

}  // namespace d2b
