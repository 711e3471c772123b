#pragma once

#include <cstdint>
#include <vector>

#include "elevations/elevation_reader.hpp"
#include "features/drawn_stack.hpp"

namespace d2b {

/// Measures the error of the stack against the elevations. @param stack as drawn, in the reader's window
[[nodiscard]] StackError measure_stack(const DrawnStack& stack, const FixedPoint& fixed,
                                       ElevationReader& reader);

/// Same for each of the stacks that end at level 1, 2, ... @param levels number of levels
[[nodiscard]] std::vector<StackError> measure_cuts(const DrawnStack& stack, std::int32_t levels,
                                                   const FixedPoint& fixed, ElevationReader& reader);

}  // namespace d2b
