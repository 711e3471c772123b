#pragma once

#include <memory>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Opens a GeoTIFF (see GeoTiffFile) that appears whole or not at all: it is written to a hidden folder next
/// to the destination, synced and renamed. In virtual file systems of GDAL it is written under a temporary
/// name. NaN and infinity become NoData. All checks that need no values are made now, because a long run
/// should not fail at its end; the file is created with the first rows. @param grid window, transform and CRS
/// of the raster @throws OptionError, OutputError like locate_raster()
[[nodiscard]] std::unique_ptr<RasterSink> open_geotiff_sink(const RasterTarget& target, const DemInfo& grid,
                                                            const RasterMeta& meta);

}  // namespace d2b
