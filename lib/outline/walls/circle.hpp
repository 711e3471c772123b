#pragma once

#include <cstddef>
#include <optional>

#include "outline/walls/wall_samples.hpp"

namespace d2b {

struct Circle {
    Vec centre;
    double radius = 0;

    [[nodiscard]] double off(Vec p) const { return length(p - centre) - radius; }
    [[nodiscard]] Vec foot(Vec p) const { return centre + radius / length(p - centre) * (p - centre); }
};

/// Fits a circle to the midpoints of steps first .. last - 1 by Taubin's algebraic fit; O(steps).
/// @return nullopt if they are collinear
[[nodiscard]] std::optional<Circle> fit_circle(const WallSamples& samples, std::size_t first,
                                               std::size_t last);

/// Circle through three points; nullopt if they are collinear.
[[nodiscard]] std::optional<Circle> circle_through(Vec a, Vec b, Vec c);

}  // namespace d2b
