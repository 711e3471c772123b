#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/statistics.hpp"

namespace d2b::contours {

/// Maximum number of levels of a label, including the root, because levels are stored in 16 bits and 0 means
/// "not valid".
inline constexpr int max_levels = std::numeric_limits<std::uint16_t>::max();

/// Thresholds per label, ascending. A point belongs to level k if z > thresholds[label][k - 1], and to level
/// 0, the root, if it is valid. Label 0 has no thresholds.
struct LevelPlan {
    double minimum = 0;                           ///< recorded as the threshold of level 0
    std::vector<std::vector<double>> thresholds;  ///< one list per label
    /// Labels are footprints: all their points belong to level 1, and its threshold, the ground, is only
    /// recorded.
    bool footprints = false;

    /// Returns the maximum number of levels of a label, including the root.
    [[nodiscard]] int level_count() const;
    [[nodiscard]] double threshold(Label label, int level) const {
        return level == 0 ? minimum : thresholds[label][static_cast<std::size_t>(level - 1)];
    }
};

/// Plans one set of thresholds for the whole DEM (Chittineni 2003, 4.1): with mean m and sample standard
/// deviation s of all valid elevations, t_i = m - s + 2 s i / (LOD + 1), i = 1..LOD; or the explicit
/// thresholds, or every multiple of an interval from an offset. Thresholds not above the minimum, not below
/// the maximum or repeated are dropped and counted in the report, which also receives the statistics.
/// @param source LevelSource::building and natural need no slices of the whole DEM
/// @throws OptionError see check_level_count()
[[nodiscard]] LevelPlan plan_global_levels(const ElevationStatistics& statistics, const LevelOptions& options,
                                           LevelSource source, Context& context);

/// Checks the number of levels of a plan.
/// @param levels maximum number of levels of a label, including the root; a double, because an interval may
/// yield more than an integer holds
/// @throws OptionError if they exceed max_levels
void check_level_count(double levels, const LevelOptions& options);

/// Counts the levels of each point. Compares doubles strictly: a point on a threshold does not exceed it.
/// Pointwise: no halo, no state.
/// @tparam Count std::uint8_t or std::uint16_t, wide enough for plan.level_count()
template <typename Count>
[[nodiscard]] LevelBand<Count> quantise(const ElevationBand& elevations, const LabelBand& labels,
                                        const LevelPlan& plan);

/// Same, for one point.
/// @param z NaN if not valid
template <typename Count>
[[nodiscard]] Count quantise(double z, Label label, const LevelPlan& plan);

extern template std::uint8_t quantise(double, Label, const LevelPlan&);
extern template std::uint16_t quantise(double, Label, const LevelPlan&);
extern template LevelBand<std::uint8_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);
extern template LevelBand<std::uint16_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);

}  // namespace d2b::contours
