#pragma once

#include <cstdint>
#include <span>

#include "ground.hpp"
#include "render.hpp"

namespace d2b::bench {

/// Whole rows of a large ground without terraces and creeks, in metres: interpolated between the points of a
/// lattice of 8 m, since all hills are far wider.
/// @param metres rows * grid.cols values
void lay_ground(const sample::Ground& ground, const sample::Grid& grid, std::int32_t first_row,
                std::int32_t rows, std::span<double> metres);

/// Puts the terraces and creeks of a ground into rows of it.
void lay_earthworks(const sample::Ground& ground, const sample::Grid& grid, std::int32_t first_row,
                    std::int32_t rows, std::span<double> metres);

}  // namespace d2b::bench
