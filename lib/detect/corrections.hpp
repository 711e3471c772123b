#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detect/detection.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {

/// Makes buildings of places that an editor marks, with a confidence of 1. The cells of a polygon that rise
/// by `min_height` become one building per connected piece, together with all objects of which half or more
/// lies in it; others lose these cells. Pieces with fewer than `min_cells` are dropped, also remaining ones
/// of others; a polygon with fewer has no effect. The object below a point becomes a building. Where
/// corrections overlap, the first takes the cells. Objects are numbered anew: buildings first, each kind in
/// scan order. Halo: the polygons and the objects that they meet.
void confirm_buildings(const Scene& scene, double min_height, std::int64_t min_cells, Detection& detection,
                       Executor& threads);

/// Divides buildings along the cuts of an editor, as cut_by_parcels() does along lines, and records which of
/// them separate two of the resulting objects.
void cut_by_corrections(const Scene& scene, double width_m, std::int64_t min_cells, Detection& detection,
                        Executor& threads);

/// Marks objects of which half or more lies in a mask of 0 and 1. They keep their cells, because units must
/// agree on them at seams; merging the units drops them. LeftOut::excluded does not apply to objects that an
/// editor has confirmed, or has denied already.
void mark_left_out(const Mask& where, LeftOut reason, Detection& detection, Executor& threads);

/// Marks the objects that an editor denies: those below points, and those of which half or more lies in
/// polygons.
void mark_denied(const Scene& scene, Detection& detection, Executor& threads);

/// Returns which corrections have had an effect, as indices among all of them: a building was made in one of
/// their cells, an object there was denied, or a cut separates two buildings. @param own core of the unit:
/// other cells are judged by other units
[[nodiscard]] std::vector<std::size_t> effective_corrections(const Scene& scene, const Detection& detection,
                                                             const Window& own);

}  // namespace d2b::detect
