#pragma once

#include "core/crs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Describes the origin of a dataset: source, options that reproduce it, decided values, thresholds, units
/// and version. Contains nothing that changes from run to run.
[[nodiscard]] Provenance make_provenance(const RunPlan& plan, const DemInfo& info, const Crs& crs,
                                         const Crs& target, const RunReport& report);

}  // namespace d2b
