#pragma once

#include <cstdint>
#include <span>

#include "render.hpp"

namespace d2b::bench {

/// Adds roughness to whole rows of smooth elevations in metres: grass, bushes, ruts and kerbs, by a
/// few decimetres.
/// @param metres rows * grid.cols values
void roughen(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
             std::span<double> metres);

/// Turns rows of elevations into a scanner's: noise, centimetres, ponds and single cells without a return.
void measure(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
             std::span<const double> metres, std::span<float> elevations);

}  // namespace d2b::bench
