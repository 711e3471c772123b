#pragma once

#include <cstdint>

#include "core/context.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/sift.hpp"

namespace d2b {

/// Counts what is no elevation in the report, and warns of it and of what may be none: the value, how many
/// cells have it, and the option that helps.
/// @param valid cells that have an elevation @param undeclared that were taken for no data, or stay
/// @throws InputError where more than half of all values are none
void report_strange_values(const StrangeValues& strange, std::int64_t valid,
                           const UndeclaredValues& undeclared, const DemInfo& info,
                           const ReadOptions& options, Context& context);

}  // namespace d2b
