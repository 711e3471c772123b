#pragma once

#include <span>

#include "compare/surveyed_building.hpp"
#include "dem2buildings/compare.hpp"

namespace d2b::compare {

/// Estimates the displacement of a survey from buildings of both that are near each other and alike: the
/// displacement that most of them share, so that changed and wrong pairs have no weight. Pairs up to three
/// cells apart along both axes are considered; with fewer than three that agree there is no shift.
/// @param cell_m side of the larger cells @param metres per unit of the coordinates
[[nodiscard]] SurveyShift estimate_shift(std::span<const SurveyedBuilding> old_buildings,
                                         std::span<const SurveyedBuilding> new_buildings, double cell_m,
                                         double metres);

}  // namespace d2b::compare
