#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace d2b {

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

}  // namespace d2b
