#pragma once

#include <cstddef>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "levels/level_plan.hpp"

namespace d2b {

/// Returns the reason why no building was found, if elevations and thresholds alone show it; a search for
/// buildings knows more (search_warnings.hpp). A clause without a full stop; "" if buildings were found, or
/// if the search has to explain it.
/// @param report report with the statistics
[[nodiscard]] std::string empty_result(const LevelPlan& plan, std::size_t buildings, const DemInfo& dem,
                                       const RunReport& report);

}  // namespace d2b
