#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gdal.h>

namespace d2b {

/// Half-open range of columns [begin, end).
using ColumnSpan = std::array<std::int32_t, 2>;

/// Limits for dividing a mosaic into columns.
struct ColumnLimits {
    std::int32_t least_cells = 2048;  ///< minimal width
    std::size_t most_columns = 16;
    std::size_t most_rasters = 16384;  ///< sum over columns, because each opens all descriptions
};

/// Divides the columns of a mosaic as evenly as possible without cutting a raster.
/// @param rasters column ranges of the rasters, not empty @return ends of the parts, ascending; a single one
/// if no cut is possible
[[nodiscard]] std::vector<std::int32_t> divide_columns(std::vector<ColumnSpan> rasters, std::int32_t cols,
                                                       const ColumnLimits& limits = {});

/// Same for a VRT mosaic; returns only the number of columns for any other dataset.
[[nodiscard]] std::vector<std::int32_t> ends_of_columns(GDALDatasetH dataset, int band);

}  // namespace d2b
