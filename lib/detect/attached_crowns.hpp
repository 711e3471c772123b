#pragma once

#include <cstdint>
#include <vector>

#include "detect/judged_objects.hpp"
#include "detect/smooth_segments.hpp"

namespace d2b {

/// Cuts tree crowns off the walls they touch. Cells more than a metre (or a cell, if larger) away from the
/// large smooth segments of an object are divided into connected parts. A part is removed if most of its
/// border belongs to the outline of the object, so that it protrudes; if the wall continues straight on both
/// sides of it (at a corner: each wall on its own side; with stronger evidence: on one side); and if it is
/// not certainly a roof, see crown_cuts(). The cut follows the lines of the walls. Objects without a large
/// segment do not change. The remaining objects keep their confidence, unless they are too small. Halo:
/// objects, the segments they meet, and ten metres and four cells around.
/// @param flags result of smoothness()
/// @param least_cells minimum size of an object
/// @param cells cells of the objects
/// @param judged objects of these cells; changed
/// @return the crowns
[[nodiscard]] std::vector<CutCrown> take_crowns_off(const Scene& scene, const SmoothSegments& segments,
                                                    const Grid<std::uint8_t>& flags, std::int64_t least_cells,
                                                    Mask cells, JudgedObjects& judged, Executor& threads);

}  // namespace d2b
