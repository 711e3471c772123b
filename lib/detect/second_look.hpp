#pragma once

#include "detect/judged_objects.hpp"

namespace d2b {

/// True if points are so sparse that houses are too rough for the usual thresholds of smoothness.
/// @param filled see SurfaceQuality
[[nodiscard]] bool deserves_second_look(double filled);

/// Relaxed pass over the elevated cells outside of the objects found so far, with three times the margin for
/// sparse points. Objects found so far are excluded, because such thresholds merge houses with adjacent
/// crowns. Objects of this pass are less often buildings, so their confidence is lowered.
/// @param cells cells of the scene as left by the first pass; changed
/// @param quality quality used by the first pass
/// @param found objects of the first pass
/// @return objects that touch none of those, not even at a corner. Objects that are too small do not count as
/// rejected, because they were too rough for the first pass. Halo: objects of both passes, the segments they
/// meet, and 11 m and four cells around them.
[[nodiscard]] JudgedObjects second_look(const Scene& scene, SceneCells& cells, double smallest_m2,
                                        SurfaceQuality quality, const Regions& found, Executor& threads);

/// Merges two sets of objects that share no edge, in scan order.
[[nodiscard]] JudgedObjects united(JudgedObjects one, const JudgedObjects& other, Executor& threads);

}  // namespace d2b
