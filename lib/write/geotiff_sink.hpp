#pragma once

#include <memory>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A GeoTIFF (see GeoTiffFile) that appears whole or not at all: it is written in a hidden folder beside the
/// destination, forced to the disk and renamed. What is in GDAL's virtual file systems is written beside
/// under another name. NaN and infinite values become NoData. The checks that need no values are made here,
/// so that a long run does not fail at its end; the file is begun with the first rows.
/// @param grid whose window, transform and CRS the raster gets
/// @throws OptionError, OutputError as locate_raster()
[[nodiscard]] std::unique_ptr<RasterSink> open_geotiff_sink(const RasterTarget& target, const DemInfo& grid,
                                                            const RasterMeta& meta);

}  // namespace d2b
