#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "scene.hpp"

namespace d2b::sample {

/// The cells over which a scene is sampled.
struct Grid {
    std::int32_t cols = 0;
    std::int32_t rows = 0;
    double cell_x = 1;  ///< metres in the scene
    double cell_y = 1;
    AffineTransform transform{0, 1, 0, 0, 0, 1};  ///< from (column, row) to the CRS; north up

    [[nodiscard]] Position centre(std::int32_t row, std::int32_t col) const;
    /// Transforms from the scene to the CRS.
    [[nodiscard]] Position to_world(const Position& scene) const;
};

/// How elevations are stored.
struct VerticalUnit {
    std::string name = "m";  ///< of the band
    double metres = 1;
    double step = 1.0 / 64;  ///< elevations are rounded to multiples of this many units: exact in binary, and
                             ///< small when compressed
};

/// Elevations of whole rows at the centres of their cells, in the given unit. Rows can be rendered in any
/// portions.
/// @param elevations rows * grid.cols values
void render(const Scene& scene, const Grid& grid, const VerticalUnit& unit, std::int32_t first_row,
            std::int32_t rows, std::span<float> elevations);

/// Raises whole rows of elevations in metres to the tops of the things that stand in a scene.
/// @param metres rows * grid.cols values
void raise(const Scene& scene, const Grid& grid, std::int32_t first_row, std::int32_t rows,
           std::span<double> metres);

}  // namespace d2b::sample
