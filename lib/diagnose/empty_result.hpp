#pragma once

#include <cstddef>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "levels/level_plan.hpp"

namespace d2b {

/// Why no building was found, where elevations and thresholds alone say it; a search for buildings says more
/// (search_warnings.hpp). Without a full stop; "" where some were found, or the search has to say why not.
/// @param report of the statistics
[[nodiscard]] std::string empty_result(const LevelPlan& plan, std::size_t buildings, const DemInfo& dem,
                                       const RunReport& report);

}  // namespace d2b
