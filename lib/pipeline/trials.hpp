#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dem2buildings/run.hpp"
#include "options/option_values.hpp"

namespace d2b::pipeline {

/// Option values that differ between trials.
struct TrialValues {
    int lod = 0;
    int noise_factor = 0;
    double detail = 0;
};

/// One run of a sweep; its features are discarded.
struct Trial {
    TrialValues values;
    RunReport report;
    double seconds = 0;  ///< wall-clock time
};

/// Observer of a trial, for example a preview picture.
class TrialView {
  public:
    TrialView() = default;
    TrialView(const TrialView&) = delete;
    TrialView& operator=(const TrialView&) = delete;
    virtual ~TrialView() = default;

    [[nodiscard]] virtual FeatureSink& features() = 0;
    [[nodiscard]] virtual RasterSink& elevations() = 0;
};
/// Creates the view of a trial. @param nothing discards the features that the view passes on
using MakeView = std::function<std::unique_ptr<TrialView>(FeatureSink& nothing, const TrialValues& values)>;

/// Runs once per combination of the plan's values; noise factors vary fastest, then details, then lods. Reads
/// each source once and keeps it in memory (8 bytes per point) because all trials need it. Issues a repeated
/// warning only once.
/// @param make_view may be empty @throws Error
[[nodiscard]] std::vector<Trial> run_trials(const Options& options, const Sources& sources,
                                            const SweepPlan& plan, const MakeView& make_view,
                                            const Callbacks& callbacks = {});

}  // namespace d2b::pipeline
