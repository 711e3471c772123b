#pragma once

#include <cstdint>
#include <span>

#include "survey.hpp"

namespace d2b::sample {

/// The highest return of each cell of some rows, in metres; NaN where no pulse came down.
/// @param metres rows * grid.cols values
void scan(const Scene& scene, const Grid& grid, const Survey& survey, std::int32_t first_row,
          std::int32_t rows, std::span<double> metres);

}  // namespace d2b::sample
