#include "contours/level_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/grid.hpp"
#include "core/text.hpp"

namespace d2b::contours {
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

// Up to this number of thresholds counting is faster than searching, because it is branch-free.
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

constexpr std::size_t cells_in_cache =
    256;  // cells that stay in the first-level cache from one threshold to the next

/// Counts the thresholds that each cell exceeds, plus one; 0 if it is not valid.
D2B_MULTIVERSION void count_exceeded(std::span<const double> elevations, std::span<const double> thresholds,
                                     std::array<std::int64_t, cells_in_cache>& counts) {
    for (std::size_t i = 0; i < elevations.size(); ++i)
        counts[i] = elevations[i] == elevations[i] ? 1 : 0;
    for (const double t : thresholds)
        for (std::size_t i = 0; i < elevations.size(); ++i)
            counts[i] += elevations[i] > t ? 1 : 0;
}

/// Quantises cells of one label.
template <typename Count>
void quantise_run(std::span<const double> elevations, Label label, const LevelPlan& plan, Count* counts) {
    const std::vector<double>& thresholds = plan.thresholds[label];
    if (thresholds.size() > few) {
        std::ranges::transform(elevations, counts, [&](double z) { return quantise<Count>(z, label, plan); });
        return;
    }
    const std::int64_t least = plan.footprints && label != 0 ? 2 : 0;
    std::array<std::int64_t, cells_in_cache> exceed{};
    for (std::size_t first = 0; first < elevations.size(); first += cells_in_cache) {
        const auto some = elevations.subspan(first, std::min(cells_in_cache, elevations.size() - first));
        count_exceeded(some, thresholds, exceed);
        for (std::size_t i = 0; i < some.size(); ++i)
            counts[first + i] = static_cast<Count>(std::max(least, exceed[i]));
    }
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
    if (levels <= max_levels)
        return;
    const std::string most = std::to_string(max_levels - 1);  // the root is not a level for users
    if (options.interval && options.fixed.empty())
        throw OptionError("-i " + number_text(*options.interval) + " gives more than " + most +
                          " levels on this DEM; use a larger interval.");
    throw OptionError("-fl and -lod give at most " + most + " levels, not " + number_text(levels - 1) + ".");
}

template <typename Count>
Count quantise(double z, Label label, const LevelPlan& plan) {
    // Invalid points of a footprint belong to it as well.
    const Count least = plan.footprints && label != 0 ? 2 : std::isnan(z) ? 0 : 1;
    return std::isnan(z) ? least : std::max(least, exceeded<Count>(z, plan.thresholds[label]));
}

template <typename Count>
LevelBand<Count> quantise(const ElevationBand& elevations, const LabelBand& labels, const LevelPlan& plan) {
    LevelBand<Count> result{elevations.shape, std::vector<Count>(elevations.shape.size())};
    const std::span<const double> all(elevations.elevations);
    for (std::size_t begin = 0; begin < all.size();) {
        const Label label = labels.labels.empty() ? 1 : labels.labels[begin];
        std::size_t end = labels.labels.empty() ? all.size() : begin + 1;
        while (end < all.size() && labels.labels[end] == label)
            ++end;
        quantise_run(all.subspan(begin, end - begin), label, plan, result.counts.data() + begin);
        begin = end;
    }
    return result;
}

template std::uint8_t quantise(double, Label, const LevelPlan&);
template std::uint16_t quantise(double, Label, const LevelPlan&);
template LevelBand<std::uint8_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);
template LevelBand<std::uint16_t> quantise(const ElevationBand&, const LabelBand&, const LevelPlan&);

}  // namespace d2b::contours
