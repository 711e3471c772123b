#pragma once

#include <cstdint>
#include <vector>

#include "detect/judged_objects.hpp"
#include "detect/smooth_segments.hpp"

namespace d2b {

/// Takes crowns off the walls that they lean on. What lies more than a metre (a cell, where cells are larger)
/// from the large smooth segments of an object falls apart into parts. A part goes if most of its border is
/// the object's own, so that it sticks out; if the wall goes on straight on both sides of it, at a corner
/// each of two walls on its own side, or with more that speaks for a crown on one side alone; and if it is
/// not a part of a building beyond doubt, see crown_cuts(). It is cut off at the lines of the walls. An
/// object without a large segment stays as it is. What is left of one is an object, or several, of its
/// confidence, unless it is too small. Halo: objects, the segments that they meet, and ten metres and four
/// cells around.
/// @param flags of smoothness()
/// @param least_cells of an object
/// @param cells of the objects
/// @param judged objects of these cells; changed
/// @return the crowns
[[nodiscard]] std::vector<CutCrown> take_crowns_off(const Scene& scene, const SmoothSegments& segments,
                                                    const Grid<std::uint8_t>& flags, std::int64_t least_cells,
                                                    Mask cells, JudgedObjects& judged, Executor& threads);

}  // namespace d2b
