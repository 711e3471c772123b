#pragma once

#include <cstdint>
#include <functional>
#include <span>

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

/// Same for grids of other types.
template <typename T>
inline constexpr T no_value_of = no_value;
template <>
inline constexpr std::int16_t no_value_of<std::int16_t> = 32767;

/// Computes the minimum or maximum within `radius` cells along a line, for every cell; lines are clipped at
/// the border of the grid. The cost per cell does not depend on the radius, except along rows, where it grows
/// with its logarithm (in the L1 cache).
/// @param into grid of the same size, other than `from`
void line_pass(const Grid<float>& from, Grid<float>& into, Line line, Extremum which, std::int32_t radius);
void line_pass(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum which,
               std::int32_t radius);

/// Called with each row just written, while it is in the L1 cache.
template <typename T>
using AfterRow = std::function<void(std::span<T>)>;

/// Fuses two passes, so that a grid passes the caches once: one extremum along lines, then the opposite one
/// on its result, of which only some rows exist at a time. Not for lines along rows.
/// @param between called with each row of the first pass @param after called with each row of `into`
void double_pass(const Grid<float>& from, Grid<float>& into, Line line, Extremum first, std::int32_t radius,
                 const AfterRow<float>& between, const AfterRow<float>& after);
void double_pass(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum first,
                 std::int32_t radius, const AfterRow<std::int16_t>& between,
                 const AfterRow<std::int16_t>& after);

/// Returns the minimum of each cell and its eight neighbours.
[[nodiscard]] MetreGrid lowest_around(const MetreGrid& grid, Executor& threads);

}  // namespace d2b::ground
