#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "options/sweep_plan.hpp"
#include "pipeline/pipeline.hpp"

namespace d2b {

/// One run of several, whose layers went nowhere.
struct Trial {
    int lod = 0;
    int noise_factor = 0;
    RunReport report;
    double seconds = 0;  ///< on the clock
};

/// What a trial's features go through, such as a picture of them. @param nothing takes them in the end
/// @param context of the trial
using TrialView = std::function<std::unique_ptr<FeatureSink>(
    FeatureSink& nothing, DemSource& dem, const Context& context, int lod, int noise_factor)>;

/// Runs the whole job for every pair of the plan, the noise factors of one lod after the other. Each source
/// is read once and kept, 8 bytes a point.
/// @param view may be empty @throws Error
[[nodiscard]] std::vector<Trial> run_trials(const Options& options, const Sources& sources,
                                            const SweepPlan& plan, const TrialView& view, Context& context);

}  // namespace d2b
