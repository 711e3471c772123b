#include "levels/quantise.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

// Up to here counting beats searching, and it has no branch.
constexpr std::size_t few = 16;

template <typename Count>
Count exceeded(double z, const std::vector<double>& thresholds) {
    if (thresholds.size() > few)
        return static_cast<Count>(
            1 + (std::lower_bound(thresholds.begin(), thresholds.end(), z) - thresholds.begin()));
    unsigned count = 1;
    for (const double t : thresholds)
        count += z > t ? 1U : 0U;
    return static_cast<Count>(count);
}

}  // namespace

template <typename Count>
Count quantise(double z, Label label, const LevelPlan& plan) {
    // A point of a footprint that is not valid is part of it all the same.
    const Count least = plan.footprints && label != 0 ? 2 : std::isnan(z) ? 0 : 1;
    return std::isnan(z) ? least : std::max(least, exceeded<Count>(z, plan.thresholds[label]));
}

template <typename Count>
LevelBand<Count> quantise(const ElevationBand& elevations, const LabelBand& labels, const LevelPlan& plan) {
    LevelBand<Count> result{elevations.shape, std::vector<Count>(elevations.shape.size())};
    for (std::size_t i = 0; i < result.counts.size(); ++i) {
        const Label label = labels.labels.empty() ? 1 : labels.labels[i];
        result.counts[i] = quantise<Count>(elevations.elevations[i], label, plan);
    }
    return result;
}

template std::uint8_t quantise(double, Label, const LevelPlan&);
template std::uint16_t quantise(double, Label, const LevelPlan&);
template LevelBand<std::uint8_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);
template LevelBand<std::uint16_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);

}  // namespace d2b
