#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/overlay.hpp"
#include "read/polygon_layer.hpp"
#include "score/heights.hpp"

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

/// Of one side, within the region.
struct SideScore {
    std::size_t features = 0;  ///< all, also outside of the region
    std::size_t invalid = 0;   ///< of all features
    std::size_t vertices = 0;  ///< of features that touch the region; the reference's are simplified before
    double area_m2 = 0;
    std::size_t objects = 0;          ///< not smaller than the smallest
    std::size_t objects_covered = 0;  ///< by the other side, at least half of each
};

/// How well found footprints agree with a reference. A share of nothing is 0.
struct Score {
    SideScore found;
    SideScore reference;
    double shared_m2 = 0;
    double completeness = 0;              ///< share of the reference's area that was found
    double correctness = 0;               ///< share of the found area that is in the reference
    double iou = 0;                       ///< shared area / area of both together
    double object_completeness = 0;       ///< share of the reference's objects that are covered
    double object_correctness = 0;        ///< share of the found objects that are covered
    double outline_m = 0;                 ///< length of the found outline
    double outline_near_m = 0;            ///< of that, within the limit of the reference's outline
    std::optional<double> outline_rms_m;  ///< over that
    double overlap = 0;             ///< area covered twice or more / area covered, of all found features
    double vertex_ratio = 0;        ///< found / reference
    std::size_t pairs = 0;          ///< of objects that match
    std::optional<double> polis_m;  ///< mean over the pairs
    std::optional<HeightErrors> heights;  ///< over the pairs where both have a height
};

/// @throws Error where GEOS fails
[[nodiscard]] Score score(ScoreSide found, ScoreSide reference, const ScoreOptions& options);

}  // namespace d2b
