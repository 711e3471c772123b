#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trace/arms.hpp"
#include "trace/components.hpp"
#include "trace/runs.hpp"

namespace d2b {

/// What lies in a band of an outline that leaves it: the chain between two of the band's borders.
struct OutlinePiece {
    std::size_t first = 0;  ///< of its corners
    std::size_t corners = 0;
    /// Along the vertical edges that lead to its first corner and from its last one, as far as the band goes.
    double outside_begin = nothing_outside;
    double outside_end = nothing_outside;
};

/// What goes on beyond a band of rows: contours that its first row or its last one passes, and their
/// outlines. A run's `component` and, at its sides, `head` and `tail` are places in the lists below.
struct OpenBand {
    RunRow top;     ///< a piece goes down from a run's head, and one ends at its tail
    RunRow bottom;  ///< a piece ends at a run's head, and one goes up from its tail
    std::int32_t last_line = 0;
    std::vector<Component> components;  ///< whose `below` is one of them, which comes before
    std::vector<OutlinePiece> pieces;
    std::vector<Corner> corners;
};

}  // namespace d2b
