#include "contours/building_levels.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/grid.hpp"

namespace d2b::contours {
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

/// @param price price in square metres of a point
std::vector<double> breaks(const ElevationHistogram& histogram, int lod, const BreakPenalty& price,
                           double metres) {
    // More bins than a building of 100 m has in tenths; higher ones get wider bins.
    constexpr std::size_t most_bins = 1024;
    const auto [width_m, bins] = histogram.bins(most_bins);
    std::vector<double> result;
    for (const std::int64_t bin :
         natural_breaks(bins, lod, static_cast<std::int64_t>(std::ceil(least_step_m / width_m)),
                        {price.fixed / (width_m * width_m), price.share}))
        result.push_back(static_cast<double>(bin) * width_m / metres);
    return result;
}

/// Price of a threshold. Its borders are about half as long as the perimeter of a square with the building's
/// area, and it has to reduce the error by a certain share, so that low buildings get thresholds as well, and
/// high ones not a dozen. On coarse cells borders cost almost nothing, and the sampling of a few points would
/// pass for a tier; therefore a threshold has to reduce the error by as much as some points that are a metre
/// off.
/// @param border_price price of a border of one cell, in square metres of a point
BreakPenalty price_of(const PointStats& stats, double border_price) {
    constexpr double least_share = 0.029;
    constexpr double least_error = 10;  // square metres of a point
    if (!(border_price > 0))
        return {};
    return {least_error + border_price * 2 * std::sqrt(static_cast<double>(stats.n)), least_share};
}

void add_even(std::span<const double> cells, Label label, std::vector<ConstantRun>& to) {
    for (std::size_t c = 0; c < cells.size();) {
        const double z = cells[c];
        const std::size_t first = c++;
        if (std::isnan(z))
            continue;
        while (c < cells.size() && cells[c] == z)
            ++c;
        to.push_back({label, static_cast<std::int64_t>(c - first), z});
    }
}

/// Returns the thresholds from the elevations of the building alone.
std::vector<double> own_thresholds(const BuildingStatistics& statistics, Label label,
                                   const LevelOptions& options, LevelSource source, double border_price,
                                   double metres) {
    return source == LevelSource::natural
               ? breaks(statistics.histogram(label), options.lod,
                        price_of(statistics.of(label), border_price * metres * metres), metres)
               : slices(statistics.of(label), statistics.fixed(), options.lod, metres);
}

}  // namespace

std::vector<ConstantRun> constant_runs(const ElevationBand& elevations, const LabelBand& labels) {
    std::vector<ConstantRun> result;
    for (std::int32_t r = 0; r < elevations.shape.rows; ++r) {
        const std::span<const double> row = elevations.row(r);
        for_equal_runs(labels.row(r), [&](std::int32_t begin, std::int32_t end, Label label) {
            add_even(row.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)),
                     label, result);
        });
    }
    return result;
}

std::vector<ConstantRun> constant_runs(const BuildingCells& cells, Label label) {
    std::vector<ConstantRun> result;
    add_even(cells.elevations, label, result);
    return result;
}

void BuildingStatistics::add(const std::vector<ConstantRun>& cells) {
    for (const ConstantRun& even : cells) {
        stats_[even.label].add(even.elevation, even.cells, fixed_);
        if (!histograms_.empty())
            histograms_[even.label].add(even.elevation * metres_, even.cells);
    }
}

LevelPlan plan_building_levels(const BuildingStatistics& statistics, const std::vector<double>& ground,
                               const LevelPlan& global, const LevelOptions& options, LevelSource source,
                               double metres, double border_price) {
    const bool own = source != LevelSource::global && options.fixed.empty() && !options.interval;
    LevelPlan plan{global.minimum, {{}}, true};
    for (Label label = 1; label <= statistics.labels(); ++label) {
        const PointStats& stats = statistics.of(label);
        std::vector<double> list{ground[label]};
        for (const double t : own ? own_thresholds(statistics, label, options, source, border_price, metres)
                                  : global.thresholds[1])
            if (t >= stats.lowest && t < stats.highest && t > list.back())
                list.push_back(t);
        plan.thresholds.push_back(std::move(list));
    }
    check_level_count(plan.level_count(), options);  // one more than the global plan, because of the ground
    return plan;
}

}  // namespace d2b::contours
