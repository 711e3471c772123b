#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gdal.h>

#include "read/band_reader.hpp"
#include "read/open_raster.hpp"

namespace d2b::reading {

/// Half-open range of columns [begin, end).
using ColumnSpan = std::array<std::int32_t, 2>;

/// Limits for dividing a mosaic into columns.
struct ColumnLimits {
    std::int32_t min_cells = 2048;  ///< minimal width
    std::size_t max_columns = 16;
    std::size_t max_rasters = 16384;  ///< sum over columns, because each opens all descriptions
};

/// Divides the columns of a mosaic as evenly as possible without cutting a raster.
/// @param rasters column ranges of the rasters, not empty @return ends of the parts, ascending; a single one
/// if no cut is possible
[[nodiscard]] std::vector<std::int32_t> divide_columns(std::vector<ColumnSpan> rasters, std::int32_t cols,
                                                       const ColumnLimits& limits = {});

/// Same for a VRT mosaic; returns only the number of columns for any other dataset.
[[nodiscard]] std::vector<std::int32_t> ends_of_columns(GDALDatasetH dataset, int band);

/// Raster that several threads read concurrently.
class ConcurrentRaster {
  public:
    ConcurrentRaster() = default;
    ConcurrentRaster(const ConcurrentRaster&) = delete;
    ConcurrentRaster& operator=(const ConcurrentRaster&) = delete;
    virtual ~ConcurrentRaster() = default;

    /// Same as BandReader::read().
    virtual void read(const Window& part, std::span<double> elevations) = 0;
};

/// Opens the implementation that suits the raster. @param path for opening it again, if that is faster for
/// several threads @param warnings outlives the result
/// @throws as BandReader
[[nodiscard]] std::unique_ptr<ConcurrentRaster> make_concurrent(OpenRaster raster, const ReadOptions& options,
                                                                std::string path, const DemInfo& info,
                                                                Warnings& warnings);

}  // namespace d2b::reading
