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

/// What of the values of a raster is no elevation, in its vertical unit.
struct SiftRules {
    ElevationLimits limits;
    SpikeRules spikes;
    double metres = 1;                       ///< in a vertical unit
    std::optional<double> set_aside_nodata;  ///< as DemInfo has it
    std::vector<double> undeclared{};        ///< values that stand for no data, see UndeclaredValues
};

/// What was seen of cells that may be no elevations. A mergeable reduction.
struct StrangeValues {
    explicit StrangeValues(const SiftRules& rules) : bins(rules.limits, rules.metres) {}
    void merge(const StrangeValues& other);
    void save(ByteWriter& writer) const;
    /// Takes what values under the same rules saved.
    void load(ByteReader& reader);

    ValueCounts outside;                ///< of the limits
    ValueCounts undeclared;             ///< values that stand for no data
    ValueCounts spikes;                 ///< that are no elevations
    std::int64_t spires = 0;            ///< spikes that are, but no roofs
    std::int64_t set_aside_nodata = 0;  ///< cells that have that elevation
    ValueBins bins;                     ///< of all within the limits, spikes too
};

/// Makes NaN of all elevations outside of the limits, and of those that stand for no data.
void limit(std::span<double> elevations, const SiftRules& rules);

/// The same, and notes what it sees on the way, which costs little more than a look at each elevation.
/// @return where cells may be spikes: nowhere else are they
[[nodiscard]] std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen);
/// The same, where what is noted is of some cells alone. @param of rows and columns of the band
[[nodiscard]] std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen,
                                        const Window& of);

}  // namespace d2b
