#pragma once

#include <limits>

#include "core/elevation_sample.hpp"
#include "dem2buildings/records.hpp"

namespace d2b {

/// What the points of a building say of its roof, but those that stand above all around them.
/// NaN where there are none of these.
struct RoofElevations {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Percentiles percentiles{unknown, unknown, unknown, unknown};
    double highest = unknown;

    friend bool operator==(const RoofElevations&, const RoofElevations&) = default;
};

/// Heights above the ground of a building that its points do not exceed, in metres. @param metres in one
/// vertical unit
[[nodiscard]] Percentiles heights_above(double ground, const RoofElevations& roof, double metres);

/// Taken when a building is finished, so that its sample can go.
[[nodiscard]] RoofElevations take_roof(const ElevationSample& sample, const ElevationRange& range);

}  // namespace d2b
