#pragma once

#include <cstdint>

#include "view/map_frame.hpp"

namespace d2b::test {

/// A raster of square cells of a metre, all of it looked at.
inline view::MapArea field(std::int32_t rows, std::int32_t cols, const Crs& crs = {},
                           const AffineTransform& transform = {0, 1, 0, 0, 0, -1}) {
    DemInfo dem;
    dem.name = "field.tif";
    dem.rows = rows;
    dem.cols = cols;
    dem.window = {0, 0, rows, cols};
    dem.transform = transform;
    return {dem, crs, {1, 1, 1}};
}

}  // namespace d2b::test
