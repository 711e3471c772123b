#include "levels/elevation_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

// Multiplied or divided by 10, because 0.1 is not a binary number.
constexpr double bins_a_metre = 10;
// Limit that lets bin indices fit into 64 bits for any elevation.
constexpr double farthest = 1e15;

/// Merges pairs of bins into bins of twice the width.
std::vector<HistogramBin> paired(const std::vector<HistogramBin>& bins) {
    std::vector<HistogramBin> pairs;
    for (const HistogramBin& bin : bins) {
        const std::int64_t pair = bin.bin >> 1;
        if (pairs.empty() || pairs.back().bin != pair)
            pairs.push_back({pair, 0});
        pairs.back().points += bin.points;
    }
    return pairs;
}

}  // namespace

void ElevationHistogram::add(double elevation_m, std::int64_t points) {
    const double end = std::clamp(std::ceil(elevation_m * bins_a_metre), -farthest, farthest);
    points_[static_cast<std::int64_t>(end) - 1] += points;
}

ElevationHistogram::Bins ElevationHistogram::bins(std::size_t most) const {
    Bins result{1 / bins_a_metre, {}};
    for (const auto& [bin, points] : points_)
        result.bins.push_back({bin, points});
    double width = 1;
    while (result.bins.size() > std::max<std::size_t>(most, 2)) {
        result.bins = paired(result.bins);
        width *= 2;
    }
    result.width_m = width / bins_a_metre;
    return result;
}

}  // namespace d2b
