#pragma once

#include <limits>

#include "core/band.hpp"
#include "core/elevation_sample.hpp"
#include "core/exact_sum.hpp"
#include "core/point_stats.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

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
