#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/statistics.hpp"

namespace d2b {

/// Levels of a label, the root counted: points are counted by them in 16 bits, where 0 is "not valid".
inline constexpr int most_levels = std::numeric_limits<std::uint16_t>::max();

/// The thresholds, ascending; a point belongs to level k where z > thresholds[label][k - 1], to level 0, the
/// root, where it is valid. Label 0 has no thresholds.
struct LevelPlan {
    double minimum = 0;                           ///< recorded as the threshold of level 0
    std::vector<std::vector<double>> thresholds;  ///< one list per label
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
/// @param source with LevelSource::building and natural there are no slices of the whole
/// @throws OptionError as check_level_count() does
[[nodiscard]] LevelPlan plan_global_levels(const ElevationStatistics& statistics, const LevelOptions& options,
                                           LevelSource source, Context& context);

/// For whoever makes a plan. @param levels of the label with most, the root counted; of an interval there may
/// be more than an integer holds @throws OptionError where they are more than most_levels
void check_level_count(double levels, const LevelOptions& options);

}  // namespace d2b
