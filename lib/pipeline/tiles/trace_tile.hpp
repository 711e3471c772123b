#pragma once

#include <cstdint>

#include "pipeline/tiles/tile_run.hpp"

namespace d2b {

// Where all points bear one label, a contour may fill the window: a tile writes what it knows of the lines
// that sweep through it, and merge traces.

/// Takes a tile's rows apart. @throws as draw_tile()
void trace_tile(TileRun& run, std::int64_t tile);
/// Joins the lines of all tiles, traces and draws. @throws as merge_tiles()
void merge_traced(TileRun& run, FeatureSink& features, CommitList& commit);

}  // namespace d2b
