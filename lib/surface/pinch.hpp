#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/node_star.hpp"

namespace d2b {

/// Consecutive sectors around a node, counter-clockwise. Sector i is on the left of arm i.
struct SectorRun {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Returns the arms that bound the sectors of a run: count + 1. @param all around the node
[[nodiscard]] std::vector<NodeArm> arms_of(const std::vector<NodeArm>& all, const SectorRun& run);

/// Options for resolving a non-manifold vertex: any of the runs may be moved off the node.
struct Pinch {
    bool fills = false;  ///< true if the runs are notches within a building, false if they are parts that
                         ///< rise above the rest
    std::vector<SectorRun> runs;  ///< at least one
};

/// Properties of contours that decide if a vertex is manifold.
struct Heights {
    std::span<const PlanContour> contours;

    [[nodiscard]] bool exceeds(std::int32_t contour, std::int64_t height) const {
        return contour != open_ground && contours[static_cast<std::size_t>(contour)].top > height;
    }
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contour == open_ground ? open_ground : contours[static_cast<std::size_t>(contour)].building;
    }
};

/// Finds the lowest height at which the vertical line over a node is a non-manifold edge, with more than two
/// walls: there, the solid occupies more than one run of sectors, for all buildings together or for a single
/// one, because each has a solid of its own. A roof that touches itself counts, too, because few programs can
/// triangulate its polygon. @param arms around the node, counter-clockwise @return the first one found
[[nodiscard]] std::optional<Pinch> find_pinch(const std::vector<NodeArm>& arms, const Heights& heights);

}  // namespace d2b
