#pragma once

#include <vector>

#include "core/context.hpp"
#include "core/options.hpp"
#include "levels/statistics.hpp"

namespace d2b {

/// The thresholds, ascending; a point belongs to level k where z > thresholds[label][k - 1], to level 0, the
/// root, where it is valid. Label 0 has no thresholds.
struct LevelPlan {
    double minimum = 0;                           ///< recorded as the threshold of level 0
    std::vector<std::vector<double>> thresholds;  ///< a list a label
    /// Labels are footprints: all their points belong to level 1, whose threshold is the ground and is only
    /// recorded.
    bool footprints = false;

    /// Levels of the label with most, the root counted.
    [[nodiscard]] int level_count() const;
    [[nodiscard]] double threshold(Label label, int level) const {
        return level == 0 ? minimum : thresholds[label][static_cast<std::size_t>(level - 1)];
    }
};

/// One set of thresholds for the whole DEM (Chittineni 2003, 4.1): with mean m and sample standard deviation
/// s of all valid elevations, t_i = m - s + 2 s i / (LOD + 1), i = 1..LOD; or the explicit ones, or every
/// multiple of an interval from an offset. Thresholds that are not above the minimum, not below the maximum
/// or repeated are dropped and counted in the report, which also gets the statistics.
/// With LevelSource::building there are no slices of the whole.
/// @throws OptionError where an interval gives more than 65,534 levels
[[nodiscard]] LevelPlan plan_global_levels(const ElevationStatistics& statistics, const LevelOptions& options,
                                           Context& context);

}  // namespace d2b
