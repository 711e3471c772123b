#pragma once

#include "core/band.hpp"
#include "levels/level_plan.hpp"

namespace d2b {

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

}  // namespace d2b
