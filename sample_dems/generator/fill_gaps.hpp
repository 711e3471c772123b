#pragma once

#include <cstdint>
#include <span>

namespace d2b::sample {

/// Fills cells that are NaN with the nearest cell that is not, of those that are equally near with the first
/// one in rows.
/// @param values rows of `cols` values
/// @param reach cells, from centre to centre; what is farther away stays NaN
/// @return how many were filled
std::int64_t fill_gaps(std::span<double> values, std::int32_t cols, double reach);

}  // namespace d2b::sample
