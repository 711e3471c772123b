#pragma once

#include <cstdint>

#include "contours/level_plan.hpp"
#include "contours/split_into_runs.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b {

/// Global parameters of tracing without detection.
struct TracedFrame {
    LevelPlan plan;
    TraceFrame frame;
};
/// @param facts of the whole window @param context counts dropped levels
[[nodiscard]] TracedFrame traced_frame(const TileRun& run, const FoundFacts& facts, Context& context);

/// Loads the results of join and issues the same warnings as an untiled run. @throws InputError
[[nodiscard]] FoundFacts load_and_report_frame(TileRun& run, FeatureSink& features);

// Tiled runs without detection. A contour may fill the whole window, so a tile stores only its part of the
// scan lines, and the merge step traces them.

/// Splits the rows of a tile into runs. @throws as draw_tile()
void trace_tile(TileRun& run, std::int64_t tile);
/// Joins the lines of all tiles, traces them and draws the contours. @throws as merge_tiles()
void merge_traced(TileRun& run, FeatureSink& features, CommitList& commit);

}  // namespace d2b
