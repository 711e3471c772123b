#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// Returns a warning with the share of outlines that stay as traced although regularisation was requested, if
/// it exceeds 5 % of the length of the buildings; without a layer of buildings, 90 % of the contours, because
/// most borders between tiers of a real roof have no wall. A clause without a full stop; "" if it is less.
/// @param cell_size_m cell size in m; 0 if unknown
[[nodiscard]] std::string traced_doubt(const OutlineLength& buildings, const OutlineLength& contours,
                                       double cell_size_m);

}  // namespace d2b
