#pragma once

#include <span>
#include <vector>

#include "trace/arms.hpp"

namespace d2b {

/// Splits a closed outline into simple rings. Because squares are joined along edges only, an outline
/// touches itself if two squares of one contour share just a corner:
///
///     # # .        the outline of the # goes around the inner dot through the corner; split there, the
///     # . #  <-    outer ring and the hole each pass it once, and the hole touches the outer ring,
///     # # #        which is valid
///
/// Loops of a planar outline nest like brackets, so one pass with a stack finds them in linear time.
/// @return at least one ring, each with at least four corners
[[nodiscard]] std::vector<std::vector<Corner>> split_at_pinches(std::span<const Corner> outline);

}  // namespace d2b
