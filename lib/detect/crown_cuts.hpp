#pragma once

#include <vector>

#include "detect/evidence.hpp"
#include "detect/part_seam.hpp"

namespace d2b {

/// Where a crown is cut off.
struct CutLine {
    SeamLine seam;
    WallLine wall;
};

/// The lines at which a part of an object is cut off as a crown: one of a wall that goes on beyond both ends
/// of the seam, two at a corner, or one of a wall whose other end the crown hides; none where the part stays.
/// @param objects the cells of all @param eaves cells that a seam may lie outside of its wall
[[nodiscard]] std::vector<CutLine> crown_cuts(const PartSeam& part, const Evidence& evidence,
                                              const Mask& objects, const CellSize& cell, int eaves);

}  // namespace d2b
