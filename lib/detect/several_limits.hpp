#pragma once

#include "detect/judged_objects.hpp"

namespace d2b {

/// True if points are so sparse, or cells so coarse, that no single threshold of smoothness suits all houses.
/// A coarse cell has the height of its highest point, which may lie anywhere in it.
/// @param side cell size in m
/// @param filled see SurfaceQuality
[[nodiscard]] bool deserves_several_limits(double side, double filled);

/// Repeats the detection with 0.5, 0.7 and 1.4 times the usual thresholds of smoothness, and selects the best
/// candidates, see best_of_looks(). Stricter thresholds separate crowns from houses, wider ones keep a rough
/// house in one piece. Candidates found by wider thresholds are less often buildings, so their confidence is
/// lowered.
/// @param cells cells of the scene; their flags are changed
/// @param quality quality used by the regular pass
/// @param usual candidates of the regular pass
/// @return objects that share no edge. Halo: objects at the widest thresholds, the segments they meet, and 11
/// m and four cells around them.
[[nodiscard]] JudgedObjects chosen_at_several_limits(const Scene& scene, SceneCells& cells,
                                                     double smallest_m2, const SurfaceQuality& quality,
                                                     JudgedObjects usual, Executor& threads);

}  // namespace d2b
