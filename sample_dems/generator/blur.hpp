#pragma once

#include <cstdint>
#include <span>

namespace d2b::sample {

/// Convolves with a Gaussian that ends at four standard deviations; at the border its weights are those of
/// the cells that there are.
/// @param values rows of `cols` values, none of them NaN
/// @param deviation cells
void blur(std::span<double> values, std::int32_t cols, double deviation);

}  // namespace d2b::sample
