#pragma once

#include "core/crs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// What a dataset says of where it comes from: source, the options that make it again, what became of them,
/// thresholds, units and version; nothing that changes from run to run.
[[nodiscard]] Provenance make_provenance(const RunPlan& plan, const DemInfo& info, const Crs& crs,
                                         const Crs& target, const RunReport& report);

}  // namespace d2b
