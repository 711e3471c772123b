#pragma once

#include <array>
#include <vector>

#include "plane.hpp"
#include "random.hpp"
#include "town_plan.hpp"

namespace d2b::sample {

/// The avenues around a quarter, counter-clockwise.
using Quad = std::array<Position, 4>;

/// The axes of a quarter's streets, with the quarter's middle as origin: along one of the avenues, or at an
/// angle that is drawn.
[[nodiscard]] Frame street_frame(const Quad& quad, Random& random);

/// The rectangles between a quarter's streets, in the frame, all of them inside the avenues.
/// @param pitch metres from avenue to avenue
[[nodiscard]] std::vector<Rect> lay_out(Quarter quarter, const Quad& quad, const Frame& frame, double pitch,
                                        Random& random);

/// The rectangle whose middle is nearest to the frame's origin; null where there is none.
[[nodiscard]] const Rect* central(const std::vector<Rect>& rects);

}  // namespace d2b::sample
