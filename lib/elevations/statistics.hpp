#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "core/statistics.hpp"

namespace d2b {

/// Number and range of values that are not NaN; the range is inverted if there are none.
struct ValueRange {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
    std::size_t known = 0;
};

/// If both 0 and -0 are extreme, either may be returned.
[[nodiscard]] ValueRange value_range(std::span<const double> values);

/// Statistics that determine the thresholds: a mergeable, exact reduction over all valid points, so that
/// bands, tiles and threads in any order yield identical thresholds.
struct ElevationStatistics {
    Moments moments;
    double minimum = std::numeric_limits<double>::infinity();
    double maximum = -std::numeric_limits<double>::infinity();

    /// Adds all elevations that are not NaN.
    void add(std::span<const double> elevations);
    /// @param elevation not NaN
    void add(double elevation);
    void merge(const ElevationStatistics& other);

    [[nodiscard]] ElevationRange range() const;
    [[nodiscard]] FixedPoint fixed_point() const;
};

}  // namespace d2b
