#pragma once

#include <cstdint>
#include <span>

namespace d2b::sample {

/// Source of the value of a cell without a return.
enum class GapFilling {
    nearest,  ///< the nearest cell that has one; of those that are equally near the first in rows
    weighted  ///< the mean of all in reach, weighted by the inverse square of the distance
};

/// Fills cells that are NaN from cells that are not.
/// @param values rows of `cols` values
/// @param reach cells, from centre to centre; cells that are farther away stay NaN
/// @return number of filled cells
std::int64_t fill_gaps(std::span<double> values, std::int32_t cols, double reach,
                       GapFilling filling = GapFilling::nearest);

}  // namespace d2b::sample
