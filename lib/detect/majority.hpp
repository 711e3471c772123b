#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Grows smooth segments over what roofs have between them (ridges, dormers, chimneys, parapets) and takes
/// single ones out of crowns: an elevated cell belongs to a building where most elevated cells around it do.
/// Halo: two neighbourhoods of 3.5 m to each side.
/// @param seeds cells of segments @param elevated cells that may belong to a building
[[nodiscard]] Mask grow_by_majority(Mask seeds, const Mask& elevated, const CellSize& cell,
                                    Executor& threads);

/// Evens a border out: a cell belongs to what most cells around it belong to, and lies in `within`.
/// Halo: a neighbourhood of 1 m to each side.
[[nodiscard]] Mask smooth_border(const Mask& mask, const Mask& within, const CellSize& cell,
                                 Executor& threads);

}  // namespace d2b
