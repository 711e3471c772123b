#pragma once

#include "core/elevation_limits.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/sift.hpp"

namespace d2b {

/// -zrange, or what occurs on land. @param metres in a vertical unit, which the limits are in
[[nodiscard]] ElevationLimits elevation_limits(const ReadOptions& options, double metres);

/// What is an elevation. @param with_spikes whether single cells above all their neighbours may be none
[[nodiscard]] SiftRules sift_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info,
                                   double metres);

}  // namespace d2b
