#pragma once

#include "levels/level_plan.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// Global parameters of tracing without detection.
struct TracedFrame {
    LevelPlan plan;
    TraceFrame frame;
};
/// @param facts of the whole window @param context counts dropped levels
[[nodiscard]] TracedFrame traced_frame(const TileRun& run, const FoundFacts& facts, Context& context);

/// Loads the results of join and issues the same warnings as an untiled run. @throws InputError
[[nodiscard]] FoundFacts tell_frame(TileRun& run, FeatureSink& features);

}  // namespace d2b
