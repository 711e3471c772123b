#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Writes a GeoTIFF of 32-bit floats on the window of a DEM: tiles of 256 x 256, DEFLATE with the
/// floating-point predictor, BigTIFF if it might exceed 4 GB. NoData is -9999, because other programs expect
/// it.
class GeoTiffFile {
  public:
    static constexpr std::int32_t tile = 256;
    static constexpr float nodata = -9999;

    /// @param target must outlive this object @param path file to write @throws OutputError
    GeoTiffFile(const WriteTarget& target, const std::string& path, const DemInfo& grid,
                const RasterMeta& meta);

    /// @param cells window of one tile, relative to the first row and column @param values row by row
    /// @throws OutputError
    void write(const Window& cells, std::span<float> values);
    /// @throws OutputError, also if only closing fails
    void close();

  private:
    void place(const DemInfo& grid, const RasterMeta& meta);
    void describe(const RasterMeta& meta);

    const WriteTarget& target_;
    DatasetOwner dataset_;
};

}  // namespace d2b
