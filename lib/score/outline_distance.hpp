#pragma once

#include <optional>
#include <span>

#include "geometry/overlay.hpp"

namespace d2b {

/// How far one outline runs from another, in units of the coordinates.
struct OutlineDistance {
    double length = 0;          ///< of the outline that was measured
    double near = 0;            ///< of that, within the limit of the reference
    std::optional<double> rms;  ///< over what is near; nothing where there is none
};

/// Distances from points of `outline`, at most `step` apart, to the nearest point of `reference`.
/// @param limit points farther than this from the reference do not count
[[nodiscard]] OutlineDistance outline_distance(std::span<const Polyline> outline,
                                               std::span<const Polyline> reference, double limit,
                                               double step);

}  // namespace d2b
