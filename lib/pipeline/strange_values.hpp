#pragma once

#include <cstdint>

#include "core/context.hpp"
#include "core/elevation_limits.hpp"
#include "dem2buildings/dem_info.hpp"
#include "dem2buildings/options.hpp"
#include "levels/sift.hpp"

namespace d2b {

/// -zrange, or what occurs on land. @param metres in a vertical unit, which the limits are in
[[nodiscard]] ElevationLimits elevation_limits(const ReadOptions& options, double metres);

/// What is an elevation. Of single cells above all their neighbours nothing is said by the thesis preset,
/// which takes elevations as they are.
[[nodiscard]] SiftRules sift_rules(const Options& options, const DemInfo& info, double metres);

/// Counts what is no elevation in the report, and warns of it and of what may be none: the value, how many
/// cells have it, and the option that helps.
/// @param valid cells that have an elevation
/// @throws InputError where more than half of all values are none
void report_strange_values(const StrangeValues& strange, std::int64_t valid, const DemInfo& info,
                           const Options& options, Context& context);

}  // namespace d2b
