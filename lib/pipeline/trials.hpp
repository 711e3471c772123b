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

/// What looks at a trial on its way, such as a picture of it.
class TrialView {
  public:
    TrialView() = default;
    TrialView(const TrialView&) = delete;
    TrialView& operator=(const TrialView&) = delete;
    virtual ~TrialView() = default;

    [[nodiscard]] virtual FeatureSink& features() = 0;
    [[nodiscard]] virtual RasterSink& elevations() = 0;
};
/// Makes the view of a trial. @param nothing takes the features in the end
using MakeView = std::function<std::unique_ptr<TrialView>(FeatureSink& nothing, const TrialValues& values)>;

/// Runs the whole job for every combination of the plan: the noise factors of one detail after the other, and
/// the details of one lod. Each source is read once and kept, 8 bytes a point.
/// What several trials would warn of is told once.
/// @param make_view makes none where it is empty @throws Error
[[nodiscard]] std::vector<Trial> run_trials(const Options& options, const Sources& sources,
                                            const SweepPlan& plan, const MakeView& make_view,
                                            const Callbacks& callbacks = {});

}  // namespace d2b
