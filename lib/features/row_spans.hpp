#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Cells of a row of the whole raster.
struct RowSpan {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns
    std::int32_t end = 0;

    friend bool operator==(const RowSpan&, const RowSpan&) = default;
};

/// The cells whose middles lie in a polygon, row by row. What lies on a border belongs to the polygon to its
/// right, or below: polygons that share a wall share no cell. @param polygon valid
[[nodiscard]] std::vector<RowSpan> row_spans(const FinePolygon& polygon);

}  // namespace d2b
