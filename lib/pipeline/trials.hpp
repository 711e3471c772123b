#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dem2buildings/run.hpp"
#include "options/sweep_plan.hpp"

namespace d2b {

/// The values that a trial has of its own.
struct TrialValues {
    int lod = 0;
    int noise_factor = 0;
    double detail = 0;
};

/// One run of several, whose layers went nowhere.
struct Trial {
    TrialValues values;
    RunReport report;
    double seconds = 0;  ///< on the clock
};

/// What a trial's features go through, such as a picture of them. @param nothing takes them in the end
using TrialView = std::function<std::unique_ptr<FeatureSink>(FeatureSink& nothing, DemSource& dem,
                                                             const TrialValues& values)>;

/// Runs the whole job for every combination of the plan: the noise factors of one detail after the other, and
/// the details of one lod. Each source is read once and kept, 8 bytes a point.
/// What several trials would warn of is told once.
/// @param view may be empty @throws Error
[[nodiscard]] std::vector<Trial> run_trials(const Options& options, const Sources& sources,
                                            const SweepPlan& plan, const TrialView& view,
                                            const Callbacks& callbacks = {});

}  // namespace d2b
