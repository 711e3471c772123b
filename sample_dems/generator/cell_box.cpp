#include "cell_box.hpp"

#include <algorithm>
#include <cmath>

#include "draft.hpp"

namespace d2b::sample {

Rect extent(const Building& building) {
    return bounds(building.footprint.exterior);
}

Rect extent(const Tree& tree) {
    return Rect{tree.trunk.x, tree.trunk.y, tree.trunk.x, tree.trunk.y}.grown(tree.radius);
}

Rect extent(const Block& block) {
    return bounds(block.frame.to_scene(rectangle(block.rect)).exterior);
}

CellBox cells_of(const Rect& box, const Grid& grid, std::int32_t first_row, std::int32_t rows) {
    const auto cell = [](double position, std::int32_t last) {
        return static_cast<std::int32_t>(std::clamp(position, 0.0, static_cast<double>(last)));
    };
    const std::int32_t top = cell(std::floor(grid.rows - box.y1 / grid.cell_y), grid.rows);
    const std::int32_t bottom = cell(std::ceil(grid.rows - box.y0 / grid.cell_y), grid.rows);
    return {cell(std::floor(box.x0 / grid.cell_x), grid.cols),
            cell(std::ceil(box.x1 / grid.cell_x), grid.cols), std::max(top, first_row),
            std::min(bottom, first_row + rows)};
}

}  // namespace d2b::sample
