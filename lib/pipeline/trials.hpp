#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/run.hpp"
#include "options/option_values.hpp"

namespace d2b::pipeline {

/// One run of a sweep; its features are discarded.
struct Trial {
    std::vector<std::string> values;  ///< one per option of the plan
    RunReport report;
    double seconds = 0;        ///< wall-clock time
    std::uint64_t digest = 0;  ///< equal for trials with the same features
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
/// Creates the view of a trial. @param discarded takes the features that the view passes on
/// @param values one per option of the plan
using MakeView =
    std::function<std::unique_ptr<TrialView>(FeatureSink& discarded, const std::vector<std::string>& values)>;

/// Runs once per combination of the plan's values; the last option varies fastest. Reads each source once and
/// keeps it in memory (8 bytes per point) because all trials need it. Issues a repeated warning only once.
/// @param make_view may be empty @throws Error
[[nodiscard]] std::vector<Trial> run_trials(const Options& options, const Sources& sources,
                                            const SweepPlan& plan, const MakeView& make_view,
                                            const Callbacks& callbacks = {});

/// Option whose largest values give the same features, whatever the values of the other options.
struct Saturation {
    std::string option;
    std::string first;  ///< smallest value of them
    std::string last;   ///< largest value tried
};
[[nodiscard]] std::vector<Saturation> saturations(const SweepPlan& plan, const std::vector<Trial>& trials);

}  // namespace d2b::pipeline
