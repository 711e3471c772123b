#pragma once

#include <span>

#include "compare/surveyed_building.hpp"

namespace d2b::compare {

/// Says whether a building that one survey lacks stands there in its heights. They must exceed 2 m on half of
/// its area. It is the same building if a quarter of its heights is the same within 1 m: trees seldom are,
/// and they cover less than three quarters of a roof. It is also the same if 60 % of its heights have changed
/// by the same amount within 1 m. One with a confidence below 0.8 is taken for the same thing anyway, because
/// it may be a tree in both.
struct StandsThere {
    bool stands = false;
    double rise_m = RoofHeights::nan;  ///< change of its height to the other survey; NaN: unknown
};

/// @param own heights of the survey that has the building, at positions in it @param other heights of the
/// other survey at the same positions; NaN: unknown
[[nodiscard]] StandsThere stands_there(std::span<const double> own, std::span<const double> other,
                                       double confidence);

}  // namespace d2b::compare
