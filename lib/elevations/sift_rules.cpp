#include "elevations/sift_rules.hpp"

namespace d2b {

ElevationLimits elevation_limits(const ReadOptions& options, double metres) {
    if (const auto& range = options.elevation_range)
        return {(*range)[0], (*range)[1]};
    return on_land.times(1 / metres);
}

SiftRules sift_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info, double metres) {
    SiftRules rules{elevation_limits(options, metres), {}, metres, info.set_aside_nodata};
    if (with_spikes)
        rules.spikes = {spikes_m.no_elevation / metres, spikes_m.no_roof / metres};
    return rules;
}

}  // namespace d2b
