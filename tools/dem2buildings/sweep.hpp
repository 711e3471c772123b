#pragma once

#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "pipeline/trials.hpp"

namespace d2b {

/// The trials of a sweep, a line each.
[[nodiscard]] std::string sweep_table(const std::vector<pipeline::Trial>& trials);
/// The same as JSON.
[[nodiscard]] std::string sweep_json(const std::vector<pipeline::Trial>& trials);

/// Runs the trials of -sweep, with -preview a contact sheet of them. @throws Error
void run_sweep(const Options& options, const Sources& sources, const SweepPlan& plan,
               const Callbacks& callbacks, const ReportReader<std::vector<pipeline::Trial>>& reader);

}  // namespace d2b
