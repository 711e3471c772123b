#pragma once

#include <cstdint>

#include "pipeline/tiles/tile_run.hpp"

namespace d2b {

// Tiled runs without detection. A contour may fill the whole window, so a tile stores only its part of the
// scan lines, and the merge step traces them.

/// Splits the rows of a tile into runs. @throws as draw_tile()
void trace_tile(TileRun& run, std::int64_t tile);
/// Joins the lines of all tiles, traces them and draws the contours. @throws as merge_tiles()
void merge_traced(TileRun& run, FeatureSink& features, CommitList& commit);

}  // namespace d2b
