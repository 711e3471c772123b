#pragma once

#include <cstdint>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::ground {

enum class Extremum { lowest, highest };

/// Direction of a linear structuring element: along a row, down a column, or down a diagonal to the right or
/// left.
enum class Line { row, column, right_diagonal, left_diagonal };

/// Value of cells without data in grids of this folder. It is the largest float, so that minima need no test
/// for it.
inline constexpr float no_value = 3.402823466e+38F;

/// Sliding minimum or maximum along lines of cells.
class RankFilter {
  public:
    /// Replaces every cell by the extremum within `radius` cells along a line; lines are clipped at the
    /// border of the grid. The cost per cell grows with the logarithm of the radius, because extrema of 2, 4,
    /// 8, ... cells are combined; the last two of these overlap.
    void apply(MetreGrid& grid, Line line, Extremum which, std::int32_t radius);

  private:
    std::vector<float> padded_;  // the grid with neutral cells around it
};

/// Returns the minimum of each cell and its eight neighbours.
[[nodiscard]] MetreGrid minimum_3x3(const MetreGrid& grid, Executor& threads);

}  // namespace d2b::ground
