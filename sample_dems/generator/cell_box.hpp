#pragma once

#include <cstdint>

#include "render.hpp"
#include "scene.hpp"

namespace d2b::sample {

/// Cells of some rows of a grid, half open.
struct CellBox {
    std::int32_t left = 0;
    std::int32_t right = 0;
    std::int32_t top = 0;
    std::int32_t bottom = 0;
};

/// Returns the bounding box of a thing in the scene.
[[nodiscard]] Rect extent(const Building& building);
[[nodiscard]] Rect extent(const Tree& tree);
[[nodiscard]] Rect extent(const Block& block);

/// The cells that a box may touch, of `rows` rows from `first_row` on.
[[nodiscard]] CellBox cells_of(const Rect& box, const Grid& grid, std::int32_t first_row, std::int32_t rows);

}  // namespace d2b::sample
