#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "levels/elevation_histogram.hpp"

namespace d2b {

/// What a break costs, in squared bins of a point.
struct BreakPrice {
    double fixed = 0;
    double share = 0;  ///< of the error without any break
};

/// Divides a histogram into the classes of least squared error about their means: the natural breaks of a
/// distribution that is a few peaks. Exact, by dynamic programming (Fisher 1958, "On grouping for maximum
/// homogeneity"), whose rows are found by divide and conquer, since the best last break only rises with the
/// end: O(breaks * bins * log(bins)).
/// @param bins ascending, without empty ones
/// @param most breaks; there are less where another one would find no room
/// @param price as many breaks are made as make error and price together least
/// @param least_bins between two breaks and above the lowest bin, counted by number
/// @return the bins that begin the classes but the lowest, by number, ascending
[[nodiscard]] std::vector<std::int64_t> natural_breaks(std::span<const HistogramBin> bins, int most,
                                                       std::int64_t least_bins, const BreakPrice& price = {});

}  // namespace d2b
