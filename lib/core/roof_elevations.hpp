#pragma once

#include <limits>

#include "core/elevation_sample.hpp"
#include "dem2buildings/records.hpp"

namespace d2b {

/// Elevations of a roof from the points of a building, without its spires. NaN if there are no such points.
struct RoofElevations {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Percentiles percentiles{unknown, unknown, unknown, unknown};
    double highest = unknown;

    friend bool operator==(const RoofElevations&, const RoofElevations&) = default;
};

/// Returns the percentiles as heights above ground in metres. @param metres in one vertical unit
[[nodiscard]] Percentiles heights_above(double ground, const RoofElevations& roof, double metres);

/// Computed as soon as a building is complete, so that its sample can be released.
[[nodiscard]] RoofElevations take_roof(const ElevationSample& sample, const ElevationRange& range);

}  // namespace d2b
