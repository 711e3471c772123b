#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contours/contour.hpp"
#include "core/context.hpp"
#include "core/georeference.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::contours {

/// Thresholds below which contours and holes are noise.
struct NoiseRules {
    int noise_factor = 0;          ///< smallest number of grid points on a ring
    double min_area_m2 = 0;        ///< smallest area
    bool keep_footprints = false;  ///< contours of level 1 come from a detector, so they are never noise
};

/// Minimum height of buildings.
struct HeightRules {
    double min_p90_m = 0;            ///< 0: no minimum
    std::span<const double> ground;  ///< elevation per label
    double metres = 1;               ///< metres per vertical unit
};

/// Returns true if the p90 of a building, rounded as in the output, is below the minimum. A building without
/// valid points has no height.
[[nodiscard]] bool is_too_low(Label label, const RoofElevations& roof, const HeightRules& rules);

/// Returns the reason if a contour is noise: its exterior ring passes fewer grid points than the noise factor
/// (Chittineni 2003, 4.2), or its traced area is too small. Roots are never noise, nor are footprints found
/// by a detector.
[[nodiscard]] std::optional<Reason> contour_noise(const Contour& contour, const NoiseRules& rules,
                                                  const SquareArea& square_area);

/// Same for a hole in a contour that is kept.
[[nodiscard]] std::optional<Reason> hole_noise(const PackedRing& hole, std::int32_t level,
                                               const NoiseRules& rules, const SquareArea& square_area);

/// Summary of a hole in a contour that is kept, because its ring is rarely needed.
struct Hole {
    std::int32_t level = 0;
    LatticePoint start;            ///< first square inside it
    LatticePoint low;              ///< lower corner of its bounding box
    LatticePoint high;             ///< upper corner of its bounding box
    std::optional<Reason> reason;  ///< reason why it may be filled
};

/// Fills holes that are noise, from low to high levels, unless they contain a contour or a remaining hole of
/// the level below. This keeps contours nested and siblings disjoint. Updates the counts in the report. O(n
/// log n) in the number of points on the rings of holes.
/// @param keys of all contours that are kept, sorted
/// @param holes grouped by contour
/// @param ring returns the ring of a hole; called in groups by contour
/// @return per hole: true if it is filled
[[nodiscard]] std::vector<bool> fill_holes(std::span<const ContourKey> keys, std::span<const Hole> holes,
                                           const std::function<LatticeRing(std::size_t)>& ring,
                                           Context& context);

}  // namespace d2b::contours
