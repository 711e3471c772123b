#pragma once

#include <cstdint>
#include <span>

#include "render.hpp"

namespace d2b::bench {

/// Marks the cells of buildings and of their yards.
/// @param built one value a cell of whole rows; those of a scene's buildings become 1
void mark_built(const sample::Scene& scene, const sample::Grid& grid, std::int32_t first_row,
                std::int32_t rows, std::span<char> built);

/// Woods and overgrown gardens between the buildings of whole rows, in metres: ragged as leaves are, with
/// gaps.
/// @param built, metres rows * grid.cols values
void plant_thickets(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
                    std::span<const char> built, std::span<double> metres);

}  // namespace d2b::bench
