#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trace/arms.hpp"
#include "trace/components.hpp"
#include "trace/runs.hpp"

namespace d2b {

/// A part of an outline that leaves its band: the chain between two crossings of the borders of the band.
struct OutlinePiece {
    std::size_t first = 0;  ///< index of its first corner
    std::size_t corners = 0;
    /// Lowest outside elevations along the vertical edges to its first and from its last corner, within the
    /// band.
    double outside_begin = nothing_outside;
    double outside_end = nothing_outside;
};

/// Contours and outlines that continue beyond a band of rows, because they cross its first or last row. In
/// runs, `component`, `head` and `tail` are indices into the lists below.
struct OpenBand {
    RunRow top;     ///< a piece starts downwards at the head of a run, and one ends at its tail
    RunRow bottom;  ///< a piece ends at the head of a run, and one starts upwards at its tail
    std::int32_t last_line = 0;
    std::vector<Component> components;  ///< sorted so that `below` refers to an earlier one
    std::vector<OutlinePiece> pieces;
    std::vector<Corner> corners;
};

}  // namespace d2b
