#pragma once

#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "pipeline/trials.hpp"

namespace d2b {

/// Returns the trials of a sweep, a line each, and a line for each option whose larger values change nothing.
[[nodiscard]] std::string sweep_table(const SweepPlan& plan, const std::vector<pipeline::Trial>& trials);
/// Returns the same as JSON.
[[nodiscard]] std::string sweep_json(const SweepPlan& plan, const std::vector<pipeline::Trial>& trials);

/// Runs the trials of -sweep, with -preview a contact sheet of them on which differences from the first trial
/// are marked. @throws Error
void run_sweep(const Options& options, const Sources& sources, const SweepPlan& plan,
               const Callbacks& callbacks, const ReportReader<std::vector<pipeline::Trial>>& reader);

}  // namespace d2b
