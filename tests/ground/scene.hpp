#pragma once

#include <limits>

#include "ground/ground.hpp"

namespace d2b::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Ground, and boxes on it.
struct Scene {
    struct Window {
        std::int32_t row, col, rows, cols;
    };
    MetreGrid surface;
    CellSize cell;

    Scene(std::int32_t rows, std::int32_t cols, CellSize size, double rise_down = 0, double rise_across = 0)
        : surface(rows, cols), cell(size) {
        for (std::int32_t i = 0; i < rows; ++i)
            for (std::int32_t j = 0; j < cols; ++j)
                surface.at(i, j) =
                    static_cast<float>(100 + i * size.down * rise_down + j * size.across * rise_across);
    }
    Scene& box(Window where, float height) {
        for (std::int32_t i = where.row; i < where.row + where.rows; ++i)
            for (std::int32_t j = where.col; j < where.col + where.cols; ++j)
                surface.at(i, j) += height;
        return *this;
    }

    [[nodiscard]] ground::Terrain terrain(double width = GroundOptions{}.max_building_width,
                                          ground::GridOrigin place = {}) const {
        Context context;
        GroundOptions options;
        options.max_building_width = width;
        MetreGrid used = surface;
        return ground::estimate_ground(used, cell, options, context, place);
    }
};

}  // namespace d2b::test
