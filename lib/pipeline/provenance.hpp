#pragma once

#include "core/crs.hpp"
#include "core/dem_info.hpp"
#include "core/feature_sink.hpp"
#include "core/options.hpp"
#include "core/report.hpp"

namespace d2b {

/// What a dataset says of where it comes from: source, method, thresholds, units and version; nothing that
/// changes from run to run.
[[nodiscard]] Provenance make_provenance(const Options& options, const DemInfo& info, const Crs& crs,
                                         const Crs& target, const RunReport& report);

}  // namespace d2b
