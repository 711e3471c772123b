#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// GeoTIFF that holds a window of a raster.
struct RasterPart {
    std::string file;  ///< relative to the folder of the raster
    Window cells;      ///< relative to the first row and column of the raster
};

/// Prepares a VRT that presents parts, written by open_geotiff_sink(), as one raster to GDAL and programs
/// based on it. Its metadata are copied from the first part, which has the first cell of the raster. Replaces
/// an existing file atomically. @throws InputError if the first part cannot be read @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_raster_parts(const std::filesystem::path& vrt,
                                                                  std::int32_t rows, std::int32_t cols,
                                                                  const std::vector<RasterPart>& parts);

}  // namespace d2b
