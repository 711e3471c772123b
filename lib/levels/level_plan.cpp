#include "levels/level_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/number_text.hpp"

namespace d2b {
namespace {

std::vector<double> sliced(const ElevationStatistics& statistics, int lod) {
    const double mean = statistics.moments.mean();
    const double deviation = statistics.moments.standard_deviation();
    std::vector<double> result;
    for (int i = 1; i <= lod; ++i) {
        const double t = mean + deviation * (2.0 * i / (lod + 1) - 1);
        // The deviation of huge values is infinite; such slices are dropped like all above the maximum.
        result.push_back(std::isfinite(t) ? t : std::numeric_limits<double>::infinity());
    }
    return result;
}

std::vector<double> multiples(const ElevationStatistics& statistics, const LevelOptions& options) {
    const double interval = *options.interval;
    const double offset = options.offset;
    const double first = std::floor((statistics.minimum - offset) / interval) + 1;
    const double last = std::ceil((statistics.maximum - offset) / interval) - 1;
    check_level_count(last - first + 2, options);  // before the list is allocated
    std::vector<double> result;
    // Counted by an integer, because adding 1 to a double beyond 2^53 does not change it.
    const auto count = static_cast<int>(std::max(0.0, last - first + 1));
    result.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
        result.push_back(offset + (first + k) * interval);
    return result;
}

std::vector<double> candidates(const ElevationStatistics& statistics, const LevelOptions& options,
                               LevelSource source) {
    if (!options.fixed.empty())
        return options.fixed;
    if (statistics.moments.n == 0)
        return {};
    if (options.interval)
        return multiples(statistics, options);
    if (source != LevelSource::global)
        return {};  // each building has its own thresholds
    return sliced(statistics, options.lod);
}

std::vector<double> usable(std::vector<double> thresholds, const ElevationStatistics& statistics,
                           RunReport& report) {
    std::sort(thresholds.begin(), thresholds.end());
    std::vector<double> kept;
    for (const double t : thresholds) {
        if (!kept.empty() && t == kept.back())
            report.count(Reason::threshold_repeated);
        else if (!(t > statistics.minimum))
            report.count(Reason::threshold_not_above_minimum);
        else if (!(t < statistics.maximum))
            report.count(Reason::threshold_not_below_maximum);
        else
            kept.push_back(t);
    }
    return kept;
}

}  // namespace

int LevelPlan::level_count() const {
    std::size_t most = 0;
    for (const auto& list : thresholds)
        most = std::max(most, list.size());
    return static_cast<int>(most) + 1;
}

LevelPlan plan_global_levels(const ElevationStatistics& statistics, const LevelOptions& options,
                             LevelSource source, Context& context) {
    RunReport& report = context.report;
    report.valid_points = statistics.moments.n;
    LevelPlan plan{0, {{}, {}}};
    if (statistics.moments.n == 0)
        return plan;
    report.minimum = plan.minimum = statistics.minimum;
    report.maximum = statistics.maximum;
    report.mean = statistics.moments.mean();
    report.standard_deviation = statistics.moments.standard_deviation();
    plan.thresholds[1] = usable(candidates(statistics, options, source), statistics, report);
    check_level_count(plan.level_count(), options);
    return plan;
}

void check_level_count(double levels, const LevelOptions& options) {
    if (levels <= most_levels)
        return;
    const std::string most = std::to_string(most_levels - 1);  // the root is not a level for users
    if (options.interval && options.fixed.empty())
        throw OptionError("-i " + number_text(*options.interval) + " gives more than " + most +
                          " levels on this DEM; use a larger interval.");
    throw OptionError("-fl and -lod give at most " + most + " levels, not " + number_text(levels - 1) + ".");
}

}  // namespace d2b
