#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"
#include "read/polygon_layer.hpp"

namespace d2b {

/// One side of a comparison.
struct ScoreSide {
    std::vector<Polygons> areas;                 ///< one a feature, valid
    std::vector<std::optional<double>> heights;  ///< one a feature, in metres
    std::vector<std::size_t> vertices;           ///< one a feature as it was given, closing ones counted
    std::size_t invalid = 0;                     ///< features that had to be repaired
};

/// Counts and repairs what is not valid; before a transformation, which could hide it.
[[nodiscard]] ScoreSide score_side(const std::vector<PolygonFeature>& footprints, Overlay& overlay);

struct ScoreOptions {
    std::optional<Polygons> region;  ///< what is outside of it is left out
    double metres = 1;               ///< in one unit of the coordinates
    double min_object_m2 = 50;
    double outline_limit_m = 3;    ///< the outline counts where it is as near to the reference's
    double outline_step_m = 0.05;  ///< between the points of the outline that are measured
    double simplify_m = 0.05;      ///< of the reference, before its vertices are counted
    double match_iou = 0.5;        ///< objects with at least this IoU are a pair
};

/// @throws Error where GEOS fails
[[nodiscard]] Score score(ScoreSide found, ScoreSide reference, const ScoreOptions& options);

}  // namespace d2b
