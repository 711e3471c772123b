#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "options/run_plan.hpp"
#include "support/masks.hpp"

namespace d2b::test {

inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

template <typename T>
Grid<T> transposed(const Grid<T>& grid) {
    Grid<T> result(grid.cols, grid.rows);
    for (std::int32_t r = 0; r < grid.rows; ++r)
        for (std::int32_t c = 0; c < grid.cols; ++c)
            result.at(c, r) = grid.at(r, c);
    return result;
}

template <typename T>
Grid<T> flipped(const Grid<T>& grid) {
    Grid<T> result(grid.rows, grid.cols);
    for (std::int32_t r = 0; r < grid.rows; ++r)
        for (std::int32_t c = 0; c < grid.cols; ++c)
            result.at(r, grid.cols - 1 - c) = grid.at(r, c);
    return result;
}

/// Height of things above the terrain, by row and column.
using Shape = std::function<float(std::int32_t, std::int32_t)>;

/// Ground with things on it.
struct Town {
    MetreGrid surface;
    MetreGrid terrain;
    CellSize cell;

    Town(std::int32_t rows, std::int32_t cols, CellSize size = {}, const Shape& ground = {})
        : surface(rows, cols, 100.0F), terrain(rows, cols, 100.0F), cell(size) {
        if (ground)
            set(terrain, ground);
        surface = terrain;
    }
    /// Elevations wherever the shape is not NaN.
    void build(const Shape& elevation) { set(surface, elevation); }
    /// A block from one cell to before another.
    void block(std::int32_t top, std::int32_t left, std::int32_t bottom, std::int32_t right,
               float elevation) {
        build([=](std::int32_t r, std::int32_t c) {
            return r >= top && r < bottom && c >= left && c < right ? elevation : unknown;
        });
    }
    [[nodiscard]] detect::Scene scene() const { return {surface, terrain, cell}; }

  private:
    static void set(MetreGrid& grid, const Shape& value) {
        for (std::int32_t r = 0; r < grid.rows; ++r)
            for (std::int32_t c = 0; c < grid.cols; ++c)
                if (const float z = value(r, c); z == z)
                    grid.at(r, c) = z;
    }
};

inline detect::Detection detect_in(const Town& town, const DetectOptions& options = {},
                                   double min_area_m2 = default_min_building_m2) {
    Context context;
    return detect::detect_buildings(town.scene(), options, min_area_m2, context);
}

inline Mask cells_with(const Grid<Label>& labels, const std::function<bool(Label)>& chosen) {
    Mask mask(labels.rows, labels.cols);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = chosen(labels.values[i]) ? 1 : 0;
    return mask;
}

inline Mask building_mask(const detect::Detection& detection) {
    return cells_with(detection.labels, [&](Label label) { return detection.is_building(label); });
}

/// A block's cells from `top`, `left` to before `bottom`, `right`.
struct Block {
    std::int32_t top, left, bottom, right;
};

/// Blocks after a vote of the nine cells around each: the cell at a corner sees but three others of
/// its block, four of nine, and goes; the cells beside it see five others, six of nine, and stay.
inline Mask without_corners(Mask mask, const std::vector<Block>& blocks) {
    for (const Block& block : blocks)
        for (const std::int32_t r : {block.top, block.bottom - 1})
            for (const std::int32_t c : {block.left, block.right - 1})
                mask.at(r, c) = 0;
    return mask;
}

/// Cells that rise above the terrain.
inline Mask raised(const Town& town) {
    Mask mask(town.surface.rows, town.surface.cols);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = town.surface.values[i] > town.terrain.values[i] ? 1 : 0;
    return mask;
}

}  // namespace d2b::test
