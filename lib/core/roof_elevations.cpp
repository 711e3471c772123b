#include "core/roof_elevations.hpp"

#include <algorithm>
#include <vector>

namespace d2b {

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
