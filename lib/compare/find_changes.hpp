#pragma once

#include <cstddef>
#include <vector>

#include "compare/surveyed_building.hpp"
#include "dem2buildings/compare.hpp"

namespace d2b::compare {

/// Building in both surveys or in one of them, with its values in each. If one survey divides it, its
/// values are those of all parts together. NaN: unknown, or not in that survey.
struct ChangedBuilding {
    Change change = Change::same;
    std::vector<std::size_t> old_indices;
    std::vector<std::size_t> new_indices;
    double p90_old_m = RoofHeights::nan;
    double p90_new_m = RoofHeights::nan;
    double rise_m = RoofHeights::nan;       ///< change of its height, see rise_m()
    double area_old_m2 = RoofHeights::nan;  ///< only where both surveys have data
    double area_new_m2 = RoofHeights::nan;  ///< only where both surveys have data
    double confidence = RoofHeights::nan;   ///< lowest of all its parts
};

struct SurveyChanges {
    SurveyShift shift;
    std::vector<ChangedBuilding> buildings;  ///< those of the new survey in its order, then those gone
    std::size_t old_outside = 0;  ///< buildings that lie by more than a half where the new survey has no data
    std::size_t new_outside = 0;
};

/// Compares two surveys of a place, in the same plane. Moves the old survey to the new one first.
/// A building that one survey lacks is looked for in its heights, if both have them (see stands_there()).
/// @param metres per unit of the coordinates @throws Error if GEOS fails
[[nodiscard]] SurveyChanges find_changes(SurveyedPlace old_place, const SurveyedPlace& new_place,
                                         double metres);

}  // namespace d2b::compare
