#pragma once

#include <cstdint>

#include "core/context.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/sift.hpp"

namespace d2b {

/// Counts invalid values in the report, and warns of these and of suspicious ones: the value, the number of
/// cells, and the option that helps.
/// @param valid number of cells with an elevation
/// @param undeclared values that were taken for no data, or are kept
/// @throws InputError if more than half of all values are invalid
void report_strange_values(const StrangeValues& strange, std::int64_t valid,
                           const UndeclaredValues& undeclared, const DemInfo& info,
                           const ReadOptions& options, Context& context);

}  // namespace d2b
