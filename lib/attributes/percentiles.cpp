#include "attributes/percentiles.hpp"

#include <algorithm>
#include <vector>

namespace d2b {

Percentiles take_percentiles(const ElevationSample& sample, const ElevationRange& range) {
    const std::vector<double> elevations =
        sample.percentiles({percentile_shares.begin(), percentile_shares.end()}, range);
    Percentiles result{};
    std::copy(elevations.begin(), elevations.end(), result.begin());
    return result;
}

}  // namespace d2b
