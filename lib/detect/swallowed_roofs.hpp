#pragma once

#include "core/executor.hpp"
#include "detect/candidates.hpp"
#include "detect/scene.hpp"
#include "detect/smoothness.hpp"

namespace d2b::detect {

/// Adds roofs that the estimated terrain passes through to the objects found so far. The ground filter takes
/// a roof for terrain if something leads up to it, or if its lower parts hardly rise above the streets. Such
/// a roof has no height, so it is no object. But its walls are still in the surface: they fall from a level
/// piece to lower ground, on two fifths of its border or more, because the rest may be hidden by trees and
/// other roofs. Terraces and quays look alike, so none of these pieces is a building: its confidence is half
/// of the one that its form has, and its doubt is CounterEvidence::ground.
/// @param scene Scene::longest_swallowed limits the length of a piece; 0: nothing is added
/// @param cells cells of the scene; their flags are updated for the quality
/// @param min_area_m2 smaller pieces are dropped
/// @param found pieces touch none of these objects
/// @return all objects, in scan order. Those that were rejected before and are part of a piece are no longer
/// rejected. Halo: a piece, the segments it meets, and 11 m and four cells around them.
[[nodiscard]] Candidates add_swallowed_roofs(const Scene& scene, SceneCells& cells, double min_height,
                                             double min_area_m2, const SurfaceQuality& quality,
                                             Candidates found, Executor& threads);

}  // namespace d2b::detect
