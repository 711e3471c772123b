#pragma once

#include <optional>
#include <span>

#include "geometry/overlay.hpp"

namespace d2b {

/// Distance of an outline from a reference, in units of the coordinates.
struct OutlineDistance {
    double length = 0;          ///< length of the measured outline
    double near = 0;            ///< length within the limit of the reference
    std::optional<double> rms;  ///< over that length; nullopt if it is 0
};

/// Samples `outline` at most every `step` and measures distances to the nearest point of `reference`.
/// @param limit points farther than this from the reference are ignored
[[nodiscard]] OutlineDistance outline_distance(std::span<const Polyline> outline,
                                               std::span<const Polyline> reference, double limit,
                                               double step);

}  // namespace d2b
