#pragma once

#include "core/label.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Which piece each cell of a building belongs to in the end. Cells are loose that an opening of their piece
/// by half of the width takes off; and, no farther than the width from a cut, those that an opening takes off
/// of what hangs together of a piece without a step of the surface: there a cut runs beside a wall. A loose
/// cell goes to the piece of most of its settled neighbours that are no step away, of equal ones to its own,
/// then to the first; so a cut moves to the wall beside it. Cells that steps surround go to their own piece
/// or, where that is not beside them, to that of most. A building of loose cells alone is its first piece's.
/// Parcels and walls never agree exactly, and the raster smears both.
/// Halo: buildings. Time O(n) for n cells but where very narrow pieces are very long.
/// @param pieces of buildings, numbered from 1 to count; each of one building @param buildings labels
[[nodiscard]] Grid<Label> settle_pieces(const Scene& scene, const Grid<Label>& pieces,
                                        const Grid<Label>& buildings, Label count, double width_m,
                                        Executor& threads);

}  // namespace d2b
