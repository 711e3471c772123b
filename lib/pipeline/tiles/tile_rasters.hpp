#pragma once

#include <cstdint>

#include "dem2buildings/open_sinks.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b {

// A raster that a run writes as one GeoTIFF tiles write as a GeoTIFF each. Options name the VRT that shows
// them as one: a.vrt, of a/0.tif, a/1.tif and so on.

/// @throws OptionError a name is none of a VRT, is taken, or is not that of a file on a disk
void require_raster_names(const Options& options);
/// Whether the files of a tile are there that are asked for.
[[nodiscard]] bool has_rasters(const TileRun& run, std::int64_t tile);
/// Of a tile's own cells; empty where nothing is asked for. @throws OutputError
[[nodiscard]] SideSinks open_tile_rasters(const TileRun& run, std::int64_t tile);
/// Makes them visible when all are complete. Where another process has been quicker, its file stays, which
/// has the same cells.
/// @throws OutputError
void finish_tile_rasters(const TileRun& run, std::int64_t tile, SideSinks& sinks);
/// Where all tiles have written theirs, shows them as one, all rasters or none. @throws InputError,
/// OutputError
void show_rasters(const TileRun& run);

}  // namespace d2b
