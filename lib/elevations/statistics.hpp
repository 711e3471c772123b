#pragma once

#include <limits>
#include <span>

#include "core/band.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Range of values; inverted if empty.
struct ValueRange {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
};

/// Returns the range of all values that are not NaN. If both 0 and -0 are extreme, either may be returned.
[[nodiscard]] ValueRange value_range(std::span<const double> values);

/// Statistics that determine the thresholds: a mergeable, exact reduction over all valid points, so that
/// bands, tiles and threads in any order yield identical thresholds.
struct ElevationStatistics {
    Moments moments;
    double minimum = std::numeric_limits<double>::infinity();
    double maximum = -std::numeric_limits<double>::infinity();

    void add(const ElevationBand& band);
    /// @param part rows and columns of the band
    void add(const ElevationBand& band, const Window& part);
    /// @param elevation not NaN
    void add(double elevation);
    void merge(const ElevationStatistics& other);

    [[nodiscard]] ElevationRange range() const;
    [[nodiscard]] FixedPoint fixed_point() const;
};

}  // namespace d2b
