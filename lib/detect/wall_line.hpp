#pragma once

#include <optional>

#include "detect/scene.hpp"

namespace d2b {

/// Position in m from the raster's first corner.
struct MetrePlace {
    double x = 0;  ///< across
    double y = 0;  ///< down
};

/// Straight seam between a protruding part and its roof.
struct SeamLine {
    MetrePlace middle;
    MetrePlace along;   ///< unit vector
    MetrePlace inward;  ///< perpendicular unit vector towards the roof
    double first = 0;   ///< start of the seam, in m along from its middle
    double last = 0;
};

/// Wall of a seam, as offsets in m inward of the seam's line.
struct WallLine {
    double at_first = 0;  ///< offset at the start of the seam
    double at_last = 0;   ///< offset at its end
};

/// Finds the wall that continues straight for some metres beyond both ends of a seam, in line with it;
/// nullopt if there is none, as at the corner of a roof.
/// @param objects cells of all objects
/// @param eaves maximum distance of a seam outside of its wall, in cells
[[nodiscard]] std::optional<WallLine> wall_beyond(const SeamLine& seam, const Mask& objects,
                                                  const CellSize& cell, int eaves);

/// Same, beyond the end farther from a point, such as the one at which another wall meets this one.
[[nodiscard]] std::optional<WallLine> wall_away_from(const MetrePlace& meeting, const SeamLine& seam,
                                                     const Mask& objects, const CellSize& cell, int eaves);

/// Same, beyond either end, if a crown hides the other one: the wall ends behind it, or another building
/// stands there.
[[nodiscard]] std::optional<WallLine> wall_beyond_one_end(const SeamLine& seam, const Mask& objects,
                                                          const CellSize& cell, int eaves);

/// Clears the cells between a seam and its wall.
/// @param roofs cells that are kept
void clear_outside(const SeamLine& seam, const WallLine& wall, const Mask& roofs, const CellSize& cell,
                   Mask& objects);

}  // namespace d2b
