#include "render.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell_box.hpp"
#include "random.hpp"

namespace d2b::sample {

Position Grid::centre(std::int32_t row, std::int32_t col) const {
    return {(col + 0.5) * cell_x, (rows - row - 0.5) * cell_y};
}

Position Grid::to_world(const Position& scene) const {
    const double col = scene.x / cell_x;
    const double row = rows - scene.y / cell_y;
    return {transform[0] + col * transform[1], transform[3] + row * transform[5]};
}

namespace {

/// The rows that are being rendered, in metres.
struct Strip {
    const Grid& grid;
    std::int32_t first_row;
    std::int32_t rows;
    std::span<double> metres;

    /// Raises the cells that a thing covers.
    template <typename Thing>
    void raise(const Thing& thing) const {
        const CellBox box = cells_of(extent(thing), grid, first_row, rows);
        for (std::int32_t row = box.top; row < box.bottom; ++row) {
            for (std::int32_t col = box.left; col < box.right; ++col) {
                double& z =
                    metres[static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(grid.cols) +
                           static_cast<std::size_t>(col)];
                z = std::max(z, thing.elevation_at(grid.centre(row, col)).value_or(z));
            }
        }
    }
};

}  // namespace

void raise(const Scene& scene, const Grid& grid, std::int32_t first_row, std::int32_t rows,
           std::span<double> metres) {
    const Strip strip{grid, first_row, rows, metres};
    for (const Building& building : scene.buildings)
        strip.raise(building);
    for (const Tree& tree : scene.trees)
        strip.raise(tree);
    for (const Block& block : scene.blocks)
        strip.raise(block);
}

void render(const Scene& scene, const Grid& grid, const VerticalUnit& unit, std::int32_t first_row,
            std::int32_t rows, std::span<float> elevations) {
    std::vector<double> metres(elevations.size());
    std::size_t i = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        for (std::int32_t col = 0; col < grid.cols; ++col)
            metres[i++] = scene.ground.at(grid.centre(row, col));
    }
    raise(scene, grid, first_row, rows, metres);
    i = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        for (std::int32_t col = 0; col < grid.cols; ++col, ++i) {
            const double z = metres[i] + scene.noise * normal_at(scene.seed, row, col);
            elevations[i] = static_cast<float>(std::floor(z / unit.metres / unit.step + 0.5) * unit.step);
        }
    }
}

}  // namespace d2b::sample
