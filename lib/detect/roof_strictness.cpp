#include "detect/roof_strictness.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "detect/morphology.hpp"
#include "detect/roof_samples.hpp"
#include "detect/step_sharpness.hpp"

namespace d2b {
namespace {

constexpr double surely_roof = 0.95;
constexpr double likely_roof = 0.5;
constexpr double inside_m = 3;
constexpr std::int64_t fewest_roofs = 2000;  // cells
// Laser scans with cells of 0.5 to 2.5 m have 0.7 to 1; the town of docs/accuracy.md as seen by satellites
// has 0.5.
constexpr double least_sharp = 0.6;
constexpr std::array<double, 4> stricter{0.9, 0.8, 0.7, 0.6};
constexpr std::int64_t most_lost = 5;  // per thousand

/// Returns the cells of the objects with a property.
/// @param has has(i): true if object i has it
template <typename Has>
Mask cells_of(const JudgedObjects& judged, const Has& has, Executor& threads) {
    Mask cells(judged.regions.rows, judged.regions.cols, 0, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (const RegionRun& run : judged.regions.row(r))
                if (has(run.label - 1))
                    std::fill(cells.row(r).begin() + run.begin, cells.row(r).begin() + run.end,
                              std::uint8_t{1});
    });
    return cells;
}

/// Returns roofs that are certain even without their right angles, because the surface alone has to show its
/// smoothness.
Mask sure_roofs(const JudgedObjects& judged, double filled, Executor& threads) {
    const auto is_sure = [&](std::size_t i) {
        Evidence without = judged.evidence[i];
        without.right_angles = even_right_angles;
        return judged.objects[i].confidence > surely_roof && judge(without, filled).confidence > surely_roof;
    };
    return cells_of(judged, is_sure, threads);
}

Mask likely_roofs(const JudgedObjects& judged, Executor& threads) {
    return cells_of(
        judged, [&](std::size_t i) { return judged.objects[i].confidence > likely_roof; }, threads);
}

std::int64_t common_cells(const Mask& a, const Mask& b) {
    return std::inner_product(a.values.begin(), a.values.end(), b.values.begin(), std::int64_t{0});
}

}  // namespace

std::optional<double> roof_strictness(const Scene& scene, const DetectOptions& options, double smallest_m2,
                                      const SurfaceQuality& quality, const JudgedObjects& first,
                                      Executor& threads) {
    const Mask buildings = sure_roofs(first, quality.unseen(), threads);
    if (step_sharpness(scene.surface, buildings, threads) < least_sharp)
        return std::nullopt;
    const std::vector<RoofSample> samples =
        roof_samples(scene, eroded(buildings, inside_m, scene.cell, threads), threads);
    std::vector<SceneCells> sample_cells;
    sample_cells.reserve(samples.size());
    for (const RoofSample& sample : samples)
        sample_cells.push_back(scene_cells(sample.scene(), options, threads));
    const auto roofs_found = [&](double factor) {
        SurfaceQuality stricter_quality = quality;
        stricter_quality.strictness = factor;
        std::int64_t cells = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const JudgedObjects judged = judged_objects(samples[i].scene(), sample_cells[i], smallest_m2,
                                                        stricter_quality, threads, LeaningCrowns::stay);
            cells += common_cells(samples[i].roofs, likely_roofs(judged, threads));
        }
        return cells;
    };
    // Reference count at the unchanged thresholds, because objects cut by the border of a sample may not be
    // found at all.
    const std::int64_t all = roofs_found(1);
    if (all < fewest_roofs)
        return std::nullopt;
    // Binary search: wider thresholds find every cell that stricter ones do.
    const auto first_too_strict = std::partition_point(stricter.begin(), stricter.end(), [&](double root) {
        return 1000 * roofs_found(root * root) >= (1000 - most_lost) * all;
    });
    return first_too_strict == stricter.begin() ? 1 : *(first_too_strict - 1);
}

}  // namespace d2b
