#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gdal.h>

namespace d2b {

/// Columns of cells: the first and the one behind the last.
using ColumnSpan = std::array<std::int32_t, 2>;

/// How columns of a mosaic are put together.
struct ColumnLimits {
    std::int32_t least_cells = 2048;  ///< side by side
    std::size_t most_columns = 16;
    std::size_t most_rasters = 16384;  ///< that are known of in all, where each column knows of all rasters
};

/// Divides so many columns of cells where no raster is cut, as evenly as that goes.
/// @param rasters that lie in them, none empty @return where each part ends, ascending; one where no place
/// will do
[[nodiscard]] std::vector<std::int32_t> divide_columns(std::vector<ColumnSpan> rasters, std::int32_t cols,
                                                       const ColumnLimits& limits = {});

/// The same of a VRT that puts rasters side by side; cols of any other dataset.
[[nodiscard]] std::vector<std::int32_t> ends_of_columns(GDALDatasetH dataset, int band);

}  // namespace d2b
