#pragma once

#include "core/context.hpp"
#include "core/dem_source.hpp"
#include "core/feature_sink.hpp"
#include "core/options.hpp"

namespace d2b {

/// The whole job: read -> detect -> levels -> trace -> filter -> outline -> attributes -> write.
/// Reads the source twice (statistics, then contours), or once where it fits in memory; the report in
/// `context` says what was done, found, dropped and repaired.
/// @param options  as checked by the option table; write.layers `automatic` means both
/// @throws Error: nothing is visible at the sink then
void run(const Options& options, DemSource& source, FeatureSink& sink, Context& context);

}  // namespace d2b
