#pragma once

#include "levels/level_plan.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "trace/take_apart.hpp"

namespace d2b {

/// What tracing needs to know of the whole where all points bear one label.
struct TracedFrame {
    LevelPlan plan;
    TraceFrame frame;
};
/// @param facts of the whole @param context in which it is counted what is dropped of the levels
[[nodiscard]] TracedFrame traced_frame(const TileRun& run, const FoundFacts& facts, Context& context);

/// What join says of the whole, told as a run tells it. @throws InputError
[[nodiscard]] FoundFacts tell_frame(TileRun& run, FeatureSink& features);

}  // namespace d2b
