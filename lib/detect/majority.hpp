#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Grows smooth segments over ridges, dormers, chimneys and parapets, and removes isolated segments in
/// crowns: an elevated cell belongs to a building if most elevated cells around it do.
/// Halo: two neighbourhoods of 3.5 m to each side.
/// @param seeds cells of segments
/// @param elevated cells that may belong to a building
[[nodiscard]] Mask grow_by_majority(Mask seeds, const Mask& elevated, const CellSize& cell,
                                    Executor& threads);

/// Smooths the border by a majority filter, restricted to `within`.
/// Halo: a neighbourhood of 1 m to each side.
[[nodiscard]] Mask smooth_border(const Mask& mask, const Mask& within, const CellSize& cell,
                                 Executor& threads);

}  // namespace d2b
