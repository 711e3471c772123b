#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Run of cells in a row of the whole raster.
struct RowSpan {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;

    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
    friend bool operator==(const RowSpan&, const RowSpan&) = default;
};

/// Rasterizes a polygon: returns the cells with their centres inside, row by row. Centres on an edge belong
/// to the polygon on the right or below, so polygons that share a wall do not share cells. @param polygon
/// valid
[[nodiscard]] std::vector<RowSpan> row_spans(const FinePolygon& polygon);

/// Half-open range of rows or columns [low, high).
struct IndexRange {
    std::int32_t low = 0;
    std::int32_t high = 0;
};

/// Returns the first cell within limits whose centre is not less than `place`.
[[nodiscard]] inline std::int32_t first_centre(double place, const IndexRange& limits) {
    return static_cast<std::int32_t>(std::clamp(std::ceil(place - 0.5), static_cast<double>(limits.low),
                                                static_cast<double>(limits.high)));
}

/// Calls use(step, place) for each line through cell centres, within limits, that an edge crosses, with the
/// coordinate of the crossing along that line. Each crossing depends on the edge and the line alone, so it is
/// the same from both sides. @param from, to ends of the edge: coordinate across the lines, then along them
template <typename Use>
void for_each_crossing(std::pair<double, double> from, std::pair<double, double> to, const IndexRange& limits,
                       const Use& use) {
    if (to < from)
        std::swap(from, to);
    const double rise = (to.second - from.second) / (to.first - from.first);
    const std::int32_t end = first_centre(to.first, limits);
    for (std::int32_t step = first_centre(from.first, limits); step < end; ++step)
        use(step, from.second + (step + 0.5 - from.first) * rise);
}

/// Calls use(row, col, below) for each pair of neighbouring cells with an edge between their centres: the
/// cell at this row and column, and the one below it or to its right. @param rows, cols limits of the cells
template <typename Use>
void for_each_cut(const Position& a, const Position& b, const IndexRange& rows, const IndexRange& cols,
                  const Use& use) {
    for_each_crossing({a.y, a.x}, {b.y, b.x}, rows, [&](std::int32_t row, double col) {
        const double left = std::ceil(col - 0.5) - 1;
        if (left >= cols.low && left < cols.high)
            use(row, static_cast<std::int32_t>(left), false);
    });
    for_each_crossing({a.x, a.y}, {b.x, b.y}, cols, [&](std::int32_t col, double row) {
        const double above = std::ceil(row - 0.5) - 1;
        if (above >= rows.low && above < rows.high)
            use(static_cast<std::int32_t>(above), col, true);
    });
}

/// Rasterizes rings under the even-odd rule, in columns (x) and rows (y) of a raster, (0, 0) being the outer
/// corner of the first cell. Polygons that share an edge leave no gap and do not overlap.
/// @param rings may repeat their first position at the end @param window the cells beyond it are left out
[[nodiscard]] std::vector<RowSpan> row_spans(std::span<const WorldRing> rings, const Window& window);

}  // namespace d2b
