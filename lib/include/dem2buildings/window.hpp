#pragma once

#include <cstdint>

namespace d2b {

/// Rows and columns of the source raster, half open: [row, row + rows) x [col, col + cols).
struct Window {
    std::int32_t row = 0;
    std::int32_t col = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;

    friend bool operator==(const Window&, const Window&) = default;
};

}  // namespace d2b
