#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::ground {

enum class Extremum { lowest, highest };

/// How a line of cells runs: along a row, down a column, or down a diagonal to the right or to the left.
enum class Line { row, column, right_diagonal, left_diagonal };

/// What cells without a value hold in the grids of this folder, so that no comparison has to look for them.
inline constexpr float no_value = 3.402823466e+38F;

/// The same in grids of other values.
template <typename T>
inline constexpr T no_value_of = no_value;
template <>
inline constexpr std::int16_t no_value_of<std::int16_t> = 32767;

/// The lowest or highest value within `radius` cells along a line, for every cell; lines are cut off at the
/// grid's border. The cost a cell does not grow with the radius but for lines along a row, where it grows
/// with its logarithm (and those are in the processor's nearest cache).
/// @param into of the same size; another grid than `from`
void line_pass(const Grid<float>& from, Grid<float>& into, Line line, Extremum which, std::int32_t radius);
void line_pass(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum which,
               std::int32_t radius);

/// What happens to a row that has just been written, while the processor's nearest cache holds it.
template <typename T>
using AfterRow = std::function<void(std::span<T>)>;

/// Two passes as one, so that a grid goes through the caches once: what one extremum finds along lines, and
/// then the other one in that, of which only some rows are there at a time. Not for lines along rows.
/// @param between called with each row of the first pass @param after called with each row of `into`
void double_pass(const Grid<float>& from, Grid<float>& into, Line line, Extremum first, std::int32_t radius,
                 const AfterRow<float>& between, const AfterRow<float>& after);
void double_pass(const Grid<std::int16_t>& from, Grid<std::int16_t>& into, Line line, Extremum first,
                 std::int32_t radius, const AfterRow<std::int16_t>& between,
                 const AfterRow<std::int16_t>& after);

/// The lowest of each cell and its eight neighbours.
[[nodiscard]] MetreGrid lowest_around(const MetreGrid& grid, Executor& threads);

}  // namespace d2b::ground
