#pragma once

#include <span>

#include "core/executor.hpp"
#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// Lowers the confidence of bridges and names them as such (CounterEvidence::bridge), because they have
/// smooth tops and sharp sides, as roofs have. A bridge is long, its deck is even, and at both ends it meets
/// the ground: either the terrain rises to the deck, or whatever lies beyond is as high as the deck, such as
/// a bank or crowns. Long and slender viaducts need only be lower at both ends than between them, because
/// cars and masts stand on their decks.
///
/// Halo: the objects and 4 m around them. Time O(n log n) for the cells of elongated objects.
/// @param regions cells of the objects @param objects by label - 1
void doubt_bridges(const Scene& scene, const Regions& regions, std::span<DetectedObject> objects,
                   Executor& threads);

}  // namespace d2b::detect
