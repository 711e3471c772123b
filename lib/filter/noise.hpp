#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/context.hpp"
#include "core/roof_elevations.hpp"
#include "core/square_area.hpp"
#include "dem2buildings/options.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// What is noise.
struct NoiseRules {
    int noise_factor = 0;          ///< fewest grid points on a ring
    double min_area_m2 = 0;        ///< smallest area
    bool keep_footprints = false;  ///< contours of level 1 were found by other means: none is noise
};

/// Which buildings are too low to be kept.
struct HeightRules {
    double min_p90_m = 0;            ///< 0: none is
    std::span<const double> ground;  ///< elevation by label
    double metres = 1;               ///< in one vertical unit
};

/// Whether a building's p90, as it is written, is below the smallest height. What has no valid point has no
/// height.
[[nodiscard]] bool is_too_low(Label label, const RoofElevations& roof, const HeightRules& rules);

/// Why a contour is noise, if it is: its exterior ring passes fewer grid points than the noise factor
/// (Chittineni 2003, 4.2), or it is smaller than the smallest area as traced. A root never is, and a
/// footprint that was found by other means is not.
[[nodiscard]] std::optional<Reason> contour_noise(const Contour& contour, const NoiseRules& rules,
                                                  const SquareArea& square_area);

/// The same for a hole in a contour that is kept.
[[nodiscard]] std::optional<Reason> hole_noise(const PackedRing& hole, std::int32_t level,
                                               const NoiseRules& rules, const SquareArea& square_area);

/// A hole in a contour that is kept: of its ring what is asked for often.
struct Hole {
    std::int32_t level = 0;
    LatticePoint start;            ///< the first square inside it
    LatticePoint low;              ///< of its box
    LatticePoint high;             ///< of its box
    std::optional<Reason> reason;  ///< why it may be filled
};

/// Fills holes that are noise, from the low level to the high: those in which no contour stands and no hole
/// of the level below that remains lies. So contours stay nested and siblings disjoint. Counted in the
/// report.
/// @param keys of all contours that are kept, sorted
/// Time is O(n log n) in the points that the holes' rings pass.
/// @param holes those of one contour one after the other
/// @param ring of a hole, by its index; those of one contour are asked for one after the other
/// @return for each hole whether it is filled
[[nodiscard]] std::vector<bool> fill_holes(std::span<const ContourKey> keys, std::span<const Hole> holes,
                                           const std::function<LatticeRing(std::size_t)>& ring,
                                           Context& context);

}  // namespace d2b
