#pragma once

#include "detect/judged_objects.hpp"

namespace d2b {

/// Whether so few points fell into the cells that houses are too rough for the limits of smoothness.
/// @param filled see SurfaceQuality
[[nodiscard]] bool deserves_second_look(double filled);

/// Looks once more at what is elevated beside the objects that were found, with three times the allowance for
/// thin points in the limits of smoothness. What is seen at once is not looked at again: with such limits
/// houses and crowns beside them are one, and so are crowns. The rest is less often a building, so each has
/// less confidence.
/// @param cells of the scene, as they were left by the first look; changed
/// @param quality of the first look
/// @param found objects of the first look
/// @return objects that share neither edge nor corner with those. What is too small to be one, too rough at
/// the first look, does not count as left out. Halo: objects of both looks, the segments that they meet, and
/// 11 m and four cells around them.
[[nodiscard]] JudgedObjects second_look(const Scene& scene, SceneCells& cells, double smallest_m2,
                                        SurfaceQuality quality, const Regions& found, Executor& threads);

/// Objects of both, in scan order, with what both left out. They share no edge.
[[nodiscard]] JudgedObjects united(JudgedObjects one, const JudgedObjects& other, Executor& threads);

}  // namespace d2b
