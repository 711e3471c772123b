#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/elevation_limits.hpp"
#include "core/value_counts.hpp"
#include "dem2buildings/dem_source.hpp"
#include "elevations/spikes.hpp"
#include "elevations/value_bins.hpp"

namespace d2b {

/// Rules for values that are not elevations, in the vertical unit of the raster.
struct SiftRules {
    ElevationLimits limits;
    SpikeRules spikes;
    double metres = 1;                       ///< metres per vertical unit
    std::optional<double> set_aside_nodata;  ///< see DemInfo
    std::vector<double> undeclared{};        ///< undeclared NoData values, see UndeclaredValues
};

/// Statistics of cells that may not be elevations. A mergeable reduction.
struct StrangeValues {
    explicit StrangeValues(const SiftRules& rules) : bins(rules.limits, rules.metres) {}
    void merge(const StrangeValues& other);
    void save(ByteWriter& writer) const;
    /// Restores statistics saved under the same rules.
    void load(ByteReader& reader);

    ValueCounts outside;                ///< values outside of the limits
    ValueCounts undeclared;             ///< NoData values that are not declared
    ValueCounts spikes;                 ///< spikes that are not elevations
    std::int64_t spires = 0;            ///< spikes that are elevations, but not roofs
    std::int64_t set_aside_nodata = 0;  ///< cells with that elevation
    ValueBins bins;                     ///< all values within the limits, including spikes
};

/// Sets elevations outside of the limits and undeclared NoData values to NaN.
void limit(std::span<double> elevations, const SiftRules& rules);

/// Same, and collects statistics, at little more than the cost of reading each elevation.
/// @return stretches that may contain spikes; there are none elsewhere
[[nodiscard]] std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen);
/// Same, but collects the statistics of a part only.
/// @param of rows and columns of the band
[[nodiscard]] std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen,
                                        const Window& of);

}  // namespace d2b
