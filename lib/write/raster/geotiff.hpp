#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// Opens a GeoTIFF (see GeoTiffFile) that appears whole or not at all: it is written to a hidden folder next
/// to the destination, synced and renamed. In virtual file systems of GDAL it is written under a temporary
/// name. NaN and infinity become NoData. All checks that need no values are made now, because a long run
/// should not fail at its end; the file is created with the first rows. @param grid window, transform and CRS
/// of the raster @throws OptionError, OutputError like resolve_file_target()
[[nodiscard]] std::unique_ptr<RasterSink> open_geotiff_sink(const FileTarget& target, const DemInfo& grid,
                                                            const RasterMetadata& meta);

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

}  // namespace d2b::writing
