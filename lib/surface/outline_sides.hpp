#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// An edge of an outline; what the contour bounds lies on its left.
struct OutlineSide {
    FinePoint from;
    FinePoint to;
    std::uint32_t contour = 0;
};

/// The edges of outlines one after the other, ring by ring, and how they meet.
struct OutlineSides {
    std::vector<OutlineSide> sides;            ///< none without length
    std::vector<std::vector<FinePoint>> cuts;  ///< corners of others within each side, from end to end
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< contours whose sides cross
};

[[nodiscard]] OutlineSides outline_sides(std::span<const PlanContour> contours);

}  // namespace d2b
