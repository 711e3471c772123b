#include "core/roof_elevations.hpp"

#include <algorithm>
#include <vector>

namespace d2b {

Percentiles heights_above(double ground, const RoofElevations& roof, double metres) {
    Percentiles heights{};
    for (std::size_t k = 0; k < heights.size(); ++k)
        heights[k] = (std::min(roof.percentiles[k], roof.highest) - ground) * metres;
    return heights;
}

RoofElevations take_roof(const ElevationSample& sample, const ElevationRange& range) {
    RoofElevations roof;
    if (sample.size() == 0)
        return roof;
    std::vector<double> shares(percentile_shares.begin(), percentile_shares.end());
    shares.push_back(1);
    const std::vector<double> elevations = sample.percentiles(shares, range);
    std::copy_n(elevations.begin(), percentile_shares.size(), roof.percentiles.begin());
    roof.highest = elevations.back();
    return roof;
}

}  // namespace d2b
