#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/node_star.hpp"

namespace d2b {

/// Neighbouring sectors around a node, counter-clockwise. Sector i lies on the left of arm i.
struct SectorRun {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// The arms that bound the sectors of a run, one more than these. @param all around the node
[[nodiscard]] std::vector<NodeArm> arms_of(const std::vector<NodeArm>& all, const SectorRun& run);

/// How a pinch may be taken apart: any of the runs may be moved off the node.
struct Pinch {
    bool fills = false;           ///< the runs are lower places within a building, else parts that stand out
    std::vector<SectorRun> runs;  ///< at least one
};

/// What a pinch depends on, of each contour.
struct Heights {
    std::span<const PlanContour> contours;

    [[nodiscard]] bool exceeds(std::int32_t contour, std::int64_t height) const {
        return contour != open_ground && contours[static_cast<std::size_t>(contour)].top > height;
    }
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contour == open_ground ? open_ground : contours[static_cast<std::size_t>(contour)].building;
    }
};

/// Looks for what makes the vertical line over a node the edge of more than two walls: above some height what
/// stands there comes in more than one run of sectors, of all buildings or of one alone, which has a solid of
/// its own. A roof that touches itself is taken for one, too: its polygon would be one that few can divide.
/// @param arms around the node, counter-clockwise @return the first that is found
[[nodiscard]] std::optional<Pinch> find_pinch(const std::vector<NodeArm>& arms, const Heights& heights);

}  // namespace d2b
