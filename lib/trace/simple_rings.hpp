#pragma once

#include <span>
#include <vector>

#include "trace/arms.hpp"

namespace d2b {

/// Cuts a closed outline into rings that pass no point twice. With squares joined along edges only, an
/// outline meets itself where two squares of one contour meet in a corner:
///
///     # # .        the outline of the # goes around the inner dot through the corner; cut there, the
///     # . #  <-    outer ring and the courtyard each pass it once, and the courtyard touches the
///     # # #        outer ring in it, which is valid
///
/// Loops of a planar outline nest like brackets, so one pass with a stack finds them. Linear.
/// @return at least one ring, each with at least four corners
[[nodiscard]] std::vector<std::vector<Corner>> split_at_pinches(std::span<const Corner> outline);

}  // namespace d2b
