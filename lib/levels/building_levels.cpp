#include "levels/building_levels.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

constexpr double least_step_m = 0.5;

std::vector<double> slices(const PointStats& stats, const FixedPoint& fixed, int lod, double metres) {
    if (stats.n < 2)
        return {};
    const double mean = fixed.mean(stats.sum, stats.n);
    const double deviation = fixed.standard_deviation(stats);
    // n + 1 slices of 2 s / (n + 1) each.
    const double most = std::floor(2 * deviation * metres / least_step_m) - 1;
    const int n = static_cast<int>(std::clamp(most, 0.0, static_cast<double>(lod)));
    std::vector<double> result;
    for (int i = 1; i <= n; ++i)
        result.push_back(mean + deviation * (2.0 * i / (n + 1) - 1));
    return result;
}

}  // namespace

void BuildingStatistics::add(const ElevationBand& elevations, const LabelBand& labels) {
    for (std::size_t i = 0; i < elevations.elevations.size(); ++i)
        if (labels.labels[i] != 0 && !std::isnan(elevations.elevations[i]))
            stats_[labels.labels[i]].add(elevations.elevations[i], fixed_);
}

LevelPlan plan_building_levels(const BuildingStatistics& statistics, const std::vector<double>& ground,
                               const LevelPlan& global, const LevelOptions& options, double metres) {
    const bool own = options.source == LevelSource::building && options.fixed.empty() && !options.interval;
    LevelPlan plan{global.minimum, {{}}, true};
    for (Label label = 1; label <= statistics.labels(); ++label) {
        const PointStats& stats = statistics.of(label);
        std::vector<double> list{ground[label]};
        for (const double t :
             own ? slices(stats, statistics.fixed(), options.lod, metres) : global.thresholds[1])
            if (t >= stats.lowest && t < stats.highest && t > list.back())
                list.push_back(t);
        plan.thresholds.push_back(std::move(list));
    }
    return plan;
}

}  // namespace d2b
