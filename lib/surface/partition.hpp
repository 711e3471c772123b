#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/plan.hpp"

namespace d2b {

/// A partition, or what stands in its way.
struct Partition {
    Plan plan;
    /// Contours that cross others, overlap them without standing on them, or reach beyond what they stand on;
    /// of two that are at odds the later one. The plan is of no use where there are any.
    std::vector<std::uint32_t> at_odds;
};

/// Divides the plane into what each contour shows from above. Edges are cut where corners of others lie on
/// them, so that all meet at nodes; all is decided on integers. O(n log n) in corners, but for crowds.
/// @param contours parents before what stands on them
[[nodiscard]] Partition make_partition(std::span<const PlanContour> contours);

/// The outlines with every corner of another that lies on one of their edges.
[[nodiscard]] std::vector<FinePolygon> noded_outlines(std::span<const PlanContour> contours);

}  // namespace d2b
