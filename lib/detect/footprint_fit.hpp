#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "raster/row_spans.hpp"

namespace d2b::detect {

/// Footprint as a unit sees it.
struct SeenFootprint {
    Label label = 0;
    std::int64_t own_cells = 0;  ///< its cells within the core of the unit
    std::int64_t elevated = 0;   ///< number of these that rise by more than the smallest height
    std::int64_t trees = 0;      ///< number of these that look like trees
    double ground = std::numeric_limits<double>::quiet_NaN();   ///< elevation in m; NaN if unknown
    double shift_m = std::numeric_limits<double>::quiet_NaN();  ///< see wall_shift()
};

/// Share of a footprint that has to rise before its walls are compared with those of the surface.
inline constexpr double least_seen_share = 0.3;

/// Measures the footprints of a unit against the surface. A cell looks like a tree if it is elevated and
/// rough, or green, and neither it nor a neighbour belongs to a building that was found.
/// @param labels footprints by cell; changed @param own core of the unit within the scene
/// @param min_height in m @return one per label with own cells, in ascending order
[[nodiscard]] std::vector<SeenFootprint> see_footprints(const Scene& scene, const Detection& detection,
                                                        Grid<Label>& labels, const Window& own,
                                                        double min_height, Executor& threads);

/// Returns the distance in m of the move, in whole cells, at which the surface falls most from the inside of
/// a footprint to open ground outside; the smallest of equally good moves. At most 5 m and half the side of a
/// square of the same area. A fall of 3 m counts in full, a cell away from the edge by half, so that a
/// footprint that is a cell smaller than its roof on all sides stays.
/// @param cells runs of the label, in scan order @param min_height open ground is not higher, in m
[[nodiscard]] double wall_shift(const Scene& scene, const Grid<Label>& labels, Label label,
                                std::span<const RowSpan> cells, double min_height);

}  // namespace d2b::detect
