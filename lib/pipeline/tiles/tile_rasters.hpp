#pragma once

#include <cstdint>

#include "dem2buildings/open_sinks.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b::tiles {

// Rasters of a tiled run: one GeoTIFF per tile instead of a single one. Options name the VRT that combines
// them: a.vrt for a/0.tif, a/1.tif and so on.

/// Checks the names. @throws OptionError a name is not that of a VRT on a disk, or is taken
void require_raster_names(const Options& options);
/// True if all requested files of a tile exist.
[[nodiscard]] bool has_rasters(const TileRun& run, std::int64_t tile);
/// Opens rasters of the tile's own cells; empty if none is asked for. @throws OutputError
[[nodiscard]] AuxiliarySinks open_tile_rasters(const TileRun& run, std::int64_t tile);
/// Publishes the rasters once all are complete. If another process was faster, its file is kept because it
/// holds the same cells.
/// @throws OutputError
void finish_tile_rasters(const TileRun& run, std::int64_t tile, AuxiliarySinks& sinks);
/// Publishes the VRTs once all tiles are written, all rasters or none. @throws InputError, OutputError
void publish_rasters(const TileRun& run);

}  // namespace d2b::tiles
