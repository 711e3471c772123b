#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace d2b::contours {

/// Number of points in one bin.
struct HistogramBin {
    std::int64_t bin = 0;  ///< index of the bin, in multiples of its width from 0
    std::int64_t points = 0;
};

/// Sparse histogram of elevations in bins of a tenth of a metre. Order does not matter. Bins begin at whole
/// multiples of their width, and an elevation on the border of two belongs to the lower one, because a point
/// on a threshold does not exceed it. Empty bins take no memory.
class ElevationHistogram {
  public:
    /// @param elevation_m finite elevation
    /// @param points number of points with it
    void add(double elevation_m, std::int64_t points = 1);
    /// Non-empty bins in ascending order. Their width is a tenth of a metre times a power of two, so that
    /// there are at most `most` of them.
    struct Bins {
        double width_m;
        std::vector<HistogramBin> bins;
    };
    [[nodiscard]] Bins bins(std::size_t most) const;

  private:
    std::map<std::int64_t, std::int64_t> points_;
};

/// Price of a break, in squared bins of a point.
struct BreakPenalty {
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
                                                       std::int64_t least_bins,
                                                       const BreakPenalty& price = {});

}  // namespace d2b::contours
