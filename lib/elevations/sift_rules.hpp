#pragma once

#include "core/context.hpp"
#include "core/elevation_limits.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/sift.hpp"

namespace d2b {

/// Returns -zrange, or the range of elevations on land.
/// @param metres metres per vertical unit, which is the unit of the limits
[[nodiscard]] ElevationLimits elevation_limits(const ReadOptions& options, double metres);

/// Returns the rules for valid elevations.
/// @param with_spikes true: single cells above all their neighbours may be invalid
[[nodiscard]] SiftRules sift_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info,
                                   double metres);

/// Finds the undeclared NoData values of a whole window; none with -inodata.
/// @param border border of the window within the limits; null: it is read
/// @param cell_m cell size in m; 0 if unknown
/// @throws InputError, Cancelled
[[nodiscard]] UndeclaredValues undeclared_values(DemSource& source, const Options& options,
                                                 const SiftRules& rules, double cell_m,
                                                 const BorderCells* border, const Context& context);

}  // namespace d2b
