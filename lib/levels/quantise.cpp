#include "levels/quantise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/processors.hpp"

namespace d2b {
namespace {

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

constexpr std::size_t piece = 256;  // cells that stay in the first-level cache from one threshold to the next

/// Counts the thresholds that each cell exceeds, plus one; 0 if it is not valid.
D2B_FOR_EACH_PROCESSOR void count_exceeded(std::span<const double> elevations,
                                           std::span<const double> thresholds,
                                           std::array<std::int64_t, piece>& counts) {
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
    std::array<std::int64_t, piece> exceed{};
    for (std::size_t first = 0; first < elevations.size(); first += piece) {
        const auto some = elevations.subspan(first, std::min(piece, elevations.size() - first));
        count_exceeded(some, thresholds, exceed);
        for (std::size_t i = 0; i < some.size(); ++i)
            counts[first + i] = static_cast<Count>(std::max(least, exceed[i]));
    }
}

}  // namespace

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

}  // namespace d2b
