#pragma once

#include "detect/judged_objects.hpp"

namespace d2b {

/// Whether so few points fell into the cells, or cells are so coarse, that no one limit of smoothness suits
/// all houses. A coarse cell has its highest point, which may lie anywhere in it.
/// @param side of the cells, metres @param filled see SurfaceQuality
[[nodiscard]] bool deserves_several_limits(double side, double filled);

/// Looks for objects at stricter and wider limits of smoothness as well: 0.5, 0.7 and 1.4 times the usual
/// ones, and takes the best of them, see best_of_looks(). At stricter limits crowns fall off a house, at
/// wider ones a rough house is one piece. What wider limits find is less often a building, so it has less
/// confidence, in the choice as in what is returned.
/// @param cells of the scene; their flags are changed
/// @param quality of the usual look
/// @param usual what it found
/// @return objects that share no edge. Halo: objects at the widest limits, the segments that they meet, and
/// 11 m and four cells around them.
[[nodiscard]] JudgedObjects chosen_at_several_limits(const Scene& scene, SceneCells& cells,
                                                     double smallest_m2, const SurfaceQuality& quality,
                                                     JudgedObjects usual, Executor& threads);

}  // namespace d2b
