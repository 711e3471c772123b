#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// Edge of an outline, with the interior of its contour on the left.
struct OutlineSide {
    FinePoint from;
    FinePoint to;
    std::uint32_t contour = 0;
};

/// Edges of all outlines, ring by ring, and their intersections.
struct OutlineSides {
    std::vector<OutlineSide> sides;  ///< none of zero length
    std::vector<std::vector<FinePoint>>
        cuts;  ///< per side: vertices of other outlines in its interior, in its direction
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< pairs of contours whose edges cross
};

[[nodiscard]] OutlineSides outline_sides(std::span<const PlanContour> contours);

}  // namespace d2b
