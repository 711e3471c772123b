#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// A GeoTIFF that holds some cells of a raster.
struct RasterPart {
    std::string file;  ///< relative to the folder of the raster
    Window cells;      ///< counted from the raster's first row and column
};

/// A VRT in which GDAL and what builds on it see parts, as open_geotiff_sink() writes them, as one
/// raster. What it says of itself is what the first part says, which has the raster's first cell. It appears
/// whole or not at all, in the place of one that is there.
/// @throws InputError the first part cannot be read, OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_raster_parts(const std::filesystem::path& vrt,
                                                                  std::int32_t rows, std::int32_t cols,
                                                                  const std::vector<RasterPart>& parts);

}  // namespace d2b
