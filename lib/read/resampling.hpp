#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gdal_alg.h>
#include <gdalwarper.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/band_reader.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

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

/// Returns positions along the edge of a part of a grid, at equal distances. @param steps per side
[[nodiscard]] std::vector<Position> edge_of(const Window& part, int steps);

/// Offset between two grids in cells: row and column of a cell in the other grid minus those in this one.
struct CellOffset {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
};

/// Returns the row and column of the raster minus those of the DEM if cells of both grids coincide to a
/// thousandth of a cell in the whole window. Returns nothing if values have to be resampled.
[[nodiscard]] std::optional<CellOffset> whole_cell_offset(const GridTransform& transform,
                                                          const DemInfo& grid);

/// Overlap of a raster with a window.
struct Coverage {
    double share = 0;  ///< share of the window's cells whose centres lie in the raster, from a sample of at
                       ///< most 201 x 201
    bool meets =
        false;  ///< true if there is any such cell; cells of small rasters are also tested against the window
};
[[nodiscard]] Coverage coverage(const GridTransform& transform, const DemInfo& raster, const DemInfo& grid);

/// Returns the size of a cell in the middle of the DEM in columns and rows of the raster, or 1 and 1 if it
/// has no image there. Uses the whole DEM, so that the result is the same for every window.
[[nodiscard]] std::array<double, 2> cell_size_in_raster(const GridTransform& transform, const DemInfo& grid);

/// Data of a ValueDataset. Must outlive that dataset.
struct ValueSource {
    BandReader& reader;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    Warnings& warnings;
    std::exception_ptr failure;  ///< last failure, because exceptions must not pass through GDAL
};

/// Wraps a BandReader as a dataset for GDAL's warper: one band of doubles with the same validity rules, NaN
/// as NoData, and no georeferencing.
[[nodiscard]] DatasetOwner value_dataset(ValueSource& source);

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
    [[nodiscard]] bool is_outside(const Window& part) const;
    void warp(const Window& part);

    std::string name_;
    GridTransform transform_;
    std::array<double, 2> cell_;  ///< size of a DEM cell in columns and rows of the raster
    /// Columns of a part. Parts begin at multiples of it in the whole DEM, because GDAL interpolates
    /// positions along their rows: windows and bands of the same DEM then get the same values.
    std::int32_t part_cols_;
    std::int32_t max_rows_;  ///< per part
    ValueSource source_;
    DatasetOwner dataset_;
    TransformerOwner approximate_;
    OperationOwner operation_;
    std::vector<double> part_;
};

}  // namespace d2b::reading
