#pragma once

#include <cstdint>
#include <optional>

#include "dem2buildings/commit_list.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b::tiles {

// Steps of a tiled run. Each step publishes its files by one rename and does nothing if they exist. Its
// output is a function of the plan, the sources and the files of the previous steps, so the result equals
// that of run(), whichever process handled which tile, when, and how often.

/// Finds the cells of given footprints, and writes those that each tile sees. Part of planning; does nothing
/// without footprints. @throws as find_tile()
void plan_footprints(TileRun& run);
/// Estimates the ground and detects buildings in the units of a tile. @throws InputError, OutputError,
/// Cancelled
void find_tile(TileRun& run, std::int64_t tile);
/// Merges the statistics of all tiles, joins objects across seams, and assigns each building to a tile.
/// @throws InputError also if a tile is missing, OutputError, Cancelled
void join_tiles(TileRun& run);
/// Traces the contours of a tile's buildings and draws those whose outlines do not depend on other tiles.
/// @throws as find_tile()
void draw_tile(TileRun& run, std::int64_t tile);
/// Draws the deferred contours, assigns all ids, and writes the result. @param run on the destination, which
/// is left unchanged if an exception is thrown @return the report of the run @throws as find_tile()
RunReport merge_tiles(TileRun& run, FeatureSink& features, const ReportReader<RunReport>& reader = {});

// For many features, tiles write files of their own: number_tiles() instead of merge_tiles(), followed by
// write_tile() for each tile.

/// Draws the deferred contours and assigns all ids. @return the report of the run @throws as find_tile()
RunReport number_tiles(TileRun& run, const ReportReader<RunReport>& reader = {});
/// True if number_tiles() is complete. @throws nothing
[[nodiscard]] bool are_numbered(const TileRun& run);
/// Writes a tile's features with their ids. @param features begun if the tile has any, and finished
/// @throws as find_tile()
void write_tile(TileRun& run, std::int64_t tile, FeatureSink& features);
/// Returns the totals of all layers in the order of the run's layers, or nullopt if a tile is not written
/// yet.
/// @param after a tile that is already written @throws InputError
[[nodiscard]] std::optional<NumberedWhole> written_totals(const TileRun& run, std::int64_t after);

}  // namespace d2b::tiles
