#pragma once

#include <optional>

#include "detect/scene.hpp"

namespace d2b {

/// Metres from the raster's first corner.
struct MetrePlace {
    double x = 0;  ///< across
    double y = 0;  ///< down
};

/// A straight seam between what sticks out of a roof and the roof.
struct SeamLine {
    MetrePlace middle;
    MetrePlace along;   ///< unit vector
    MetrePlace inward;  ///< unit vector at a right angle, towards the roof
    double first = 0;   ///< where the seam ends, metres along from its middle
    double last = 0;
};

/// The wall that a seam lies in: how far inward of the seam's line it is, metres.
struct WallLine {
    double at_first = 0;  ///< where the seam begins
    double at_last = 0;   ///< and where it ends
};

/// The wall that goes on beyond both ends of a seam for some metres, straight and in its line, if there is
/// one. At the corner of a roof there is none.
/// @param objects the cells of all
/// @param eaves cells that a seam may lie outside of its wall
[[nodiscard]] std::optional<WallLine> wall_beyond(const SeamLine& seam, const Mask& objects,
                                                  const CellSize& cell, int eaves);

/// The same beyond one end alone: that farther from a place, such as where another wall meets this one.
[[nodiscard]] std::optional<WallLine> wall_away_from(const MetrePlace& meeting, const SeamLine& seam,
                                                     const Mask& objects, const CellSize& cell, int eaves);

/// The same beyond either end, where a crown hides the other: the wall ends behind it, or another building
/// stands there.
[[nodiscard]] std::optional<WallLine> wall_beyond_one_end(const SeamLine& seam, const Mask& objects,
                                                          const CellSize& cell, int eaves);

/// Clears cells that lie between a seam and its wall. @param roofs cells that stay
void clear_outside(const SeamLine& seam, const WallLine& wall, const Mask& roofs, const CellSize& cell,
                   Mask& objects);

}  // namespace d2b
