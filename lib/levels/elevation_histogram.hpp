#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace d2b {

/// Points that lie in one bin.
struct HistogramBin {
    std::int64_t bin = 0;  ///< its number, counted in its width from 0
    std::int64_t points = 0;
};

/// How many elevations lie in each bin of a tenth of a metre: a reduction in which order does not matter.
/// Bins begin at whole multiples of their width, and an elevation on the border of two belongs to the lower
/// one, as a point on a threshold does not exceed it. Empty bins take no room.
class ElevationHistogram {
  public:
    /// @param elevation_m finite @param points that have it
    void add(double elevation_m, std::int64_t points = 1);
    /// Ascending, of a width that leaves at most `most` of them: a tenth of a metre times a power of two.
    struct Bins {
        double width_m;
        std::vector<HistogramBin> bins;
    };
    [[nodiscard]] Bins bins(std::size_t most) const;

  private:
    std::map<std::int64_t, std::int64_t> points_;
};

}  // namespace d2b
