#pragma once

#include <map>
#include <set>
#include <vector>

#include "support/trace_grid.hpp"

namespace d2b::test {

/// The same regions found the slow way: a flood fill a level, and outlines by walking around them.
struct ReferenceContour {
    std::int32_t level = 0;
    std::set<LatticePoint> squares;
    LatticePoint parent_first;  ///< first square of the contour one level down
    std::int64_t exterior_points = 0;
    std::size_t interiors = 0;
};

[[nodiscard]] std::vector<ReferenceContour> reference_contours(const TraceGrid& grid,
                                                               const std::vector<double>& thresholds,
                                                               TraceMode mode);

/// The unit squares inside a polygon, by a test of every square's centre against every edge.
[[nodiscard]] std::set<LatticePoint> squares_inside(const contours::Contour& contour);

}  // namespace d2b::test
