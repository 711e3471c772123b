#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// How much of the outlines stays as it was traced although more was asked for, where that is more than 5 %
/// of the length of the buildings'; where these are no layer, more than 90 % of the contours': most borders
/// between tiers of a real roof have no wall. Without a full stop; "" where it is less.
/// @param cell_size_m side of a cell; 0 where it is not known
[[nodiscard]] std::string traced_doubt(const OutlineLength& buildings, const OutlineLength& contours,
                                       double cell_size_m);

}  // namespace d2b
