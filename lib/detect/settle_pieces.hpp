#pragma once

#include "core/label.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Assigns the final piece to each cell of a building. Parcels and walls never agree exactly, and the raster
/// blurs both. Therefore cells are unassigned that an opening of their piece by half of the width removes
/// and, within this width of a cut, cells that an opening removes from step-free parts of a piece, because a
/// cut there runs next to a wall. An unassigned cell then gets the piece of most of its assigned neighbours
/// that are not separated by a step (its own piece wins ties, then the first), so that a cut moves to the
/// wall next to it. Cells enclosed by steps get their own piece or, if it is not adjacent, that of most
/// neighbours. Buildings without any assigned cell become their first piece.
/// Halo: buildings. Time O(n) for n cells, except for very long and narrow pieces.
/// @param pieces pieces of buildings, numbered from 1 to count, each within one building
/// @param buildings labels of buildings
[[nodiscard]] Grid<Label> settle_pieces(const Scene& scene, const Grid<Label>& pieces,
                                        const Grid<Label>& buildings, Label count, double width_m,
                                        Executor& threads);

}  // namespace d2b
