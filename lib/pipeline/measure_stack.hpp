#pragma once

#include "elevations/elevation_reader.hpp"
#include "features/drawn_stack.hpp"

namespace d2b {

/// How far the stack is from the elevations. @param stack as it is drawn, in the reader's window
[[nodiscard]] StackError measure_stack(const DrawnStack& stack, const FixedPoint& fixed,
                                       ElevationReader& reader);

}  // namespace d2b
