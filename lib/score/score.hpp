#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"
#include "read/polygon_layer.hpp"

namespace d2b::score {

/// One side of a comparison.
struct ScoreSide {
    std::vector<Polygons> areas;                 ///< one per feature, valid
    std::vector<std::optional<double>> heights;  ///< one per feature, in metres
    std::vector<std::size_t> vertices;           ///< one per original feature, including closing vertices
    std::size_t invalid = 0;                     ///< number of repaired features
};

/// Counts and repairs invalid features. Call before a transformation, because that could hide them.
[[nodiscard]] ScoreSide score_side(const std::vector<PolygonFeature>& footprints, Overlay& overlay);

struct ScoreOptions {
    std::optional<Polygons> region;  ///< areas and outlines are clipped to it
    double metres = 1;               ///< metres per unit of the coordinates
    double min_object_m2 = 50;
    double outline_limit_m = 3;    ///< largest distance from the reference at which the outline counts
    double outline_step_m = 0.05;  ///< distance between sample points on the outline
    /// tolerance for simplifying the reference before counting its vertices, and outlines before counting
    /// their corners
    double simplify_m = 0.05;
    double match_iou = 0.5;           ///< minimum IoU of a pair of objects
    std::optional<double> cell_m{};   ///< shorter side of a cell; nullopt: short edges are not counted
    double direction_below_m2 = 400;  ///< pairs of larger objects have no direction
};

/// Scores found footprints against a reference: completeness, correctness and IoU of areas, counts of objects
/// covered at least half, and, for pairs of objects with a sufficient IoU, PoLiS distances and height errors.
/// Measures the shape of both sides.
/// Both sides must be in the same plane (see transform_to()). Areas are dissolved first, because touching
/// features would otherwise count as several objects; overlaps within the found side are reported instead.
/// @throws Error if GEOS fails
[[nodiscard]] Score score(ScoreSide found, ScoreSide reference, const ScoreOptions& options);

}  // namespace d2b::score
