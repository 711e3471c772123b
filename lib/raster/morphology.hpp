#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace d2b {

/// Row of a structuring element: columns [left, right] relative to the origin, `down` rows below it.
struct ElementRow {
    std::int32_t down;
    std::int32_t left;
    std::int32_t right;
};
/// Structuring element. All elements used here contain the origin's column in each row, and their rows are
/// nested intervals.
using Element = std::vector<ElementRow>;

/// True if a disk reaches the centre of another cell.
[[nodiscard]] bool disk_fits(double radius_m, const CellSize& cell);

/// Returns the cells whose centre is within the radius; a block of two by two cells if the radius is less
/// than a cell.
[[nodiscard]] Element disk_element(double radius_m, const CellSize& cell);

/// Erosion by a disk; the border is replicated. If the radius is less than a cell, the structuring element is
/// a block of two by two cells. Halo: the radius.
[[nodiscard]] Mask erode(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// Opening by a disk, which removes thin bridges and spikes. If the radius is less than a cell, the
/// structuring element is a block of two by two cells. The border is replicated. Halo: twice the radius.
[[nodiscard]] Mask open_mask(const Mask& mask, double radius_m, const CellSize& cell, Executor& threads);

/// Dilation by a square: adds the cells that are at most `reach` rows and columns away. O(cells).
[[nodiscard]] Mask dilate(const Mask& mask, std::int32_t reach);

/// Geodesic dilation: adds 4-neighbours within `within`, `steps` times. Halo: one cell per step.
[[nodiscard]] Mask dilate_within(Mask mask, const Mask& within, int steps, Executor& threads);

/// Fills small holes: 4-connected regions of zeros with fewer than `fewer_than` cells that do not touch the
/// border.
void fill_small_holes(Mask& mask, std::int64_t fewer_than, Executor& threads);

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
