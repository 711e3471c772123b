#pragma once

#include <cstdint>
#include <optional>

#include "dem2buildings/commit_list.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "tiles/numbered_tile.hpp"

namespace d2b {

// The steps of a run in tiles. Each writes its files in one rename, whatever else there is, and does nothing
// where they are there. What they write is a function of the plan, the sources and the files of the steps
// before: the result is that of run(), whichever process did which tile, when, and how often.

/// Ground and detection of the units of a tile. @throws InputError, OutputError, Cancelled
void find_tile(TileRun& run, std::int64_t tile);
/// Sums up what is known of all tiles, joins what seams between units cut, and gives each building to a tile.
/// @throws InputError also where a tile has not been found, OutputError, Cancelled
void join_tiles(TileRun& run);
/// The contours of a tile's buildings, and the features of those whose outlines depend on no other tile's.
/// @throws as find_tile()
void draw_tile(TileRun& run, std::int64_t tile);
/// Draws what is left, numbers all, and writes the result. @param run on the destination, which stays as it
/// was where something is thrown @return the report of the run @throws as find_tile()
RunReport merge_tiles(TileRun& run, FeatureSink& features, const ReportReader<RunReport>& reader = {});

// Where features are many, tiles write them into files of their own: number_tiles() comes in the place of
// merge_tiles(), and write_tile() for each tile after it.

/// Draws what is left and numbers all. @return the report of the run @throws as find_tile()
RunReport number_tiles(TileRun& run, const ReportReader<RunReport>& reader = {});
/// Whether that has been done. @throws nothing
[[nodiscard]] bool are_numbered(const TileRun& run);
/// Writes a tile's features, with their numbers. @param features begun where the tile has some, and finished
/// @throws as find_tile()
void write_tile(TileRun& run, std::int64_t tile, FeatureSink& features);
/// What all layers come to, by their place in the run's. @return nothing as long as a tile is not written
/// @param after a tile that was written @throws InputError
[[nodiscard]] std::optional<NumberedWhole> written_parts(const TileRun& run, std::int64_t after);

}  // namespace d2b
