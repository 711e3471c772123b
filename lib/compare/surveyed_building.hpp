#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compare/height_grid.hpp"
#include "dem2buildings/records.hpp"
#include "geometry/overlay.hpp"

namespace d2b::compare {

/// Heights above ground of a building in metres. NaN: unknown.
struct RoofHeights {
    Percentiles percentiles{nan, nan, nan, nan};
    double highest = nan;

    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    [[nodiscard]] double p90() const { return percentiles[p90_share]; }
};

/// Building as a survey has it.
struct SurveyedBuilding {
    std::int64_t id = 0;
    Polygons outline;    ///< valid, in the plane of the comparison
    Polygons written;    ///< outline in the CRS of the result
    double area_m2 = 0;  ///< of the outline
    RoofHeights heights;
    double confidence = RoofHeights::nan;  ///< 0 to 1; NaN: unknown
};

/// All buildings of a survey.
struct SurveyedPlace {
    std::vector<SurveyedBuilding> buildings;
    std::optional<SurveyHeights> heights;  ///< nothing for a survey of which only the buildings are known
    double cell_m = 1;
};

/// Heights of several buildings together, weighted by area. Between the known percentiles of a building its
/// heights are evenly distributed; if only p90 is known, all its points have that height. @param buildings at
/// least one @return NaN if the p90 of one of them is unknown
[[nodiscard]] RoofHeights joint_heights(std::span<const SurveyedBuilding* const> buildings);

/// Change of height from one survey to the next: the median of the changes of p50, p70 and p90, because
/// crowns over a roof change p90 alone. The change of p90 if that is all that is known, or if the percentiles
/// of a survey are not in order. NaN if a p90 is unknown.
[[nodiscard]] double rise_m(const RoofHeights& before, const RoofHeights& after);

}  // namespace d2b::compare
