#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "levels/elevation_histogram.hpp"

namespace d2b {

/// Price of a break, in squared bins of a point.
struct BreakPrice {
    double fixed = 0;
    double share = 0;  ///< share of the error without any break
};

/// Divides a histogram into classes with the least squared error about their means: the natural breaks
/// (Jenks) of a distribution with several peaks. Exact, by dynamic programming (Fisher 1958, "On grouping for
/// maximum homogeneity"). Rows are computed by divide and conquer, because the best previous break is
/// monotonic: O(breaks * bins * log(bins)).
/// @param bins ascending, without empty ones
/// @param most maximum number of breaks; fewer if there is no room
/// @param price the number of breaks minimises error plus price
/// @param least_bins minimum distance between breaks and above the lowest bin, in bin indices
/// @return first bins of all classes but the lowest, by index, ascending
[[nodiscard]] std::vector<std::int64_t> natural_breaks(std::span<const HistogramBin> bins, int most,
                                                       std::int64_t least_bins, const BreakPrice& price = {});

}  // namespace d2b
