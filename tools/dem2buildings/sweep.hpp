#pragma once

#include <string>
#include <vector>

#include "pipeline/trials.hpp"

namespace d2b {

/// The trials of a sweep, a line each.
[[nodiscard]] std::string sweep_table(const std::vector<Trial>& trials);
/// The same as JSON.
[[nodiscard]] std::string sweep_json(const std::vector<Trial>& trials);

/// Runs the trials of -sweep, with -preview a contact sheet of them. @throws Error
[[nodiscard]] std::vector<Trial> run_sweep(const Options& options, const Sources& sources,
                                           const SweepPlan& plan, const Callbacks& callbacks);

}  // namespace d2b
