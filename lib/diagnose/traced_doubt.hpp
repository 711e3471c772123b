#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// How much of the buildings' outlines stays as it was traced although more was asked for, where that is more
/// than 5 % of their length. Without a full stop; "" where it is less.
/// @param cell_size_m side of a cell; 0 where it is not known
[[nodiscard]] std::string traced_doubt(const RunReport& report, double cell_size_m);

}  // namespace d2b
