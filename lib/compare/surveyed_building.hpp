#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

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
    /// Less certain than the survey demands of its buildings: proves that something stands there, and is no
    /// building that could be new or gone.
    bool doubtful = false;
};

/// All buildings of a survey.
struct SurveyedPlace {
    std::vector<SurveyedBuilding> buildings;
    std::optional<Polygons> covered;  ///< area in which the survey has data; nothing: everywhere
    double cell_m = 1;
};

/// Height above ground that 90 % of several buildings do not exceed, weighted by area. Between the known
/// percentiles of a building its heights are evenly distributed. @param buildings at least one @return NaN if
/// the height of one of them is unknown
[[nodiscard]] double joint_p90(std::span<const SurveyedBuilding* const> buildings);

}  // namespace d2b::compare
