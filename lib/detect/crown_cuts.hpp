#pragma once

#include <vector>

#include "detect/evidence.hpp"
#include "detect/part_seam.hpp"

namespace d2b {

/// Line along which a crown is cut off.
struct CutLine {
    SeamLine seam;
    WallLine wall;
};

/// Returns the lines along which a part of an object is cut off as a crown: one if a wall continues beyond
/// both ends of the seam, two at a corner, or one if the crown hides the other end of the wall; none if the
/// part stays.
/// @param objects cells of all objects
/// @param eaves maximum distance of a seam outside of its wall, in cells
[[nodiscard]] std::vector<CutLine> crown_cuts(const PartSeam& part, const Evidence& evidence,
                                              const Mask& objects, const CellSize& cell, int eaves);

}  // namespace d2b
