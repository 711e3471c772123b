#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Run of cells in a row of the whole raster.
struct RowSpan {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;

    friend bool operator==(const RowSpan&, const RowSpan&) = default;
};

/// Rasterizes a polygon: returns the cells with their centres inside, row by row. Centres on an edge belong
/// to the polygon on the right or below, so polygons that share a wall do not share cells. @param polygon
/// valid
[[nodiscard]] std::vector<RowSpan> row_spans(const FinePolygon& polygon);

}  // namespace d2b
