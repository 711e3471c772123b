#pragma once

#include <cstddef>
#include <vector>

#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// Steps at which a chain may turn: the vertices of its Douglas-Peucker simplification with a tolerance of
/// 0.8 cells. Starts with 0; an open chain ends with its last step.
[[nodiscard]] std::vector<std::size_t> turning_points(const WallSamples& samples);

/// Direction shared by the long stretches of a chain, modulo 90 degrees, in radians.
/// @param points steps at which it may turn
[[nodiscard]] double dominant_direction(const WallSamples& samples, const std::vector<std::size_t>& points);

}  // namespace d2b
