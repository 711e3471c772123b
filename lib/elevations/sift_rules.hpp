#pragma once

#include "core/context.hpp"
#include "core/elevation_limits.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/sift.hpp"

namespace d2b {

/// -zrange, or what occurs on land. @param metres in a vertical unit, which the limits are in
[[nodiscard]] ElevationLimits elevation_limits(const ReadOptions& options, double metres);

/// What is an elevation. @param with_spikes whether single cells above all their neighbours may be none
[[nodiscard]] SiftRules sift_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info,
                                   double metres);

/// The values of a whole window that stand for no data without being declared; none with -inodata.
/// @param border of the window within the limits; null: it is read @param cell_m side of a cell; 0 where it
/// is not known @throws InputError, Cancelled
[[nodiscard]] UndeclaredValues undeclared_values(DemSource& source, const Options& options,
                                                 const SiftRules& rules, double cell_m,
                                                 const BorderCells* border, const Context& context);

}  // namespace d2b
