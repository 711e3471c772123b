#include "detect/detection.hpp"

#include <span>
#include <utility>

#include "core/grid.hpp"
#include "detect/bridges.hpp"
#include "detect/candidates.hpp"
#include "detect/corrections.hpp"
#include "detect/detection_passes.hpp"
#include "detect/divide_buildings.hpp"
#include "detect/priors.hpp"
#include "detect/sampling_rules.hpp"
#include "detect/swallowed_roofs.hpp"
#include "detect/threshold_scale.hpp"

namespace d2b::detect {
namespace {

constexpr float lowest_roof_m = 1;  // lower objects are cars, hedges or errors of the ground

/// Returns the first cells of the chosen regions.
template <typename Chosen>
std::vector<FirstCell> first_cells(const Regions& regions, const Chosen& chosen) {
    std::vector<FirstCell> cells;
    for_first_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        if (chosen(regions.cells[run.label]))
            cells.push_back({r, run.begin});
    });
    return cells;
}

/// @param smooth receives the limits of smoothness in the usual pass
Candidates detect_candidates(const Scene& scene, const DetectOptions& options, double min_area_m2,
                             SmoothnessThresholds& smooth, Executor& threads) {
    SceneCells cells = scene_cells(scene, options, threads);
    SurfaceQuality quality = surface_quality(scene, cells, threads);
    quality.threshold_scale = estimate_threshold_scale(scene, cells, options, min_area_m2, quality, threads);
    Candidates judged = find_candidates(scene, cells, min_area_m2, quality, threads);
    smooth = smoothness_thresholds(scene.side(), quality);
    judged.rejected.low =
        low_roofs(scene, cells.flags, options.min_height, cells_covering(min_area_m2, scene.cell), threads);
    if (needs_multi_threshold(scene.side(), quality.filled))
        judged = multi_threshold_candidates(scene, cells, min_area_m2, quality, std::move(judged), threads);
    const PriorShare prior = apply_scene_prior(quality.filled, judged.objects);
    if (prior.usual_appearance)
        apply_spatial_prior(judged.regions, scene.cell, prior, judged.objects, threads);
    doubt_bridges(scene, judged.regions, judged.objects, threads);
    return add_swallowed_roofs(scene, cells, options.min_height, min_area_m2, quality, std::move(judged),
                               threads);
}

/// Sorts buildings before doubtful objects, each in scan order.
Detection sorted_by_confidence(Candidates&& judged, double least, Executor& threads) {
    Detection result;
    result.rejected = std::move(judged.rejected);
    std::vector<Label> number(judged.regions.cells.size(), 0);
    for (const bool sure : {true, false}) {
        for (std::size_t i = 0; i < judged.objects.size(); ++i)
            if ((judged.objects[i].confidence >= least) == sure) {
                result.objects.push_back(judged.objects[i]);
                number[i + 1] = static_cast<Label>(result.objects.size());
                result.objects.back().whole = number[i + 1];
            }
        if (sure)
            result.buildings = static_cast<Label>(result.objects.size());
    }
    result.labels = label_grid(judged.regions, number, threads);
    return result;
}

}  // namespace

std::vector<FirstCell> remove_small(Regions& regions, std::int64_t min_cells) {
    const auto is_small = [&](std::int64_t cells) { return cells < min_cells; };
    std::vector<FirstCell> cells = first_cells(regions, is_small);
    keep_regions(regions, [&](Label label) { return !is_small(regions.cells[label]); });
    return cells;
}

std::vector<FirstCell> low_roofs(const Scene& scene, const Grid<std::uint8_t>& flags, double min_height,
                                 std::int64_t min_cells, Executor& threads) {
    if (!(min_height > static_cast<double>(lowest_roof_m)))
        return {};
    const auto is_low = [most = static_cast<float>(min_height)](float z, float ground) {
        const float height = z - ground;
        return height > lowest_roof_m && height <= most;
    };
    const Mask low = cells_where(scene, is_low, threads);
    return first_cells(smooth_regions(scene, low, flags, threads),
                       [&](std::int64_t cells) { return cells >= min_cells; });
}

Detection detect_buildings(const Scene& scene, const DetectOptions& options, double min_area_m2,
                           Context& context) {
    Executor& threads = *context.threads;
    SmoothnessThresholds smooth{};
    Detection result = sorted_by_confidence(detect_candidates(scene, options, min_area_m2, smooth, threads),
                                            options.min_confidence, threads);
    result.smooth = smooth;
    const std::int64_t min_cells = cells_covering(min_area_m2, scene.cell);
    confirm_buildings(scene, options.min_height, min_cells, result, threads);
    if (scene.parcels != nullptr)
        cut_by_parcels(scene, options.split_width, min_cells, result, threads);
    cut_by_corrections(scene, options.split_width, min_cells, result, threads);
    if (options.split_height > 0)
        split_buildings(scene, options.split_height, min_cells, result, threads);
    return result;
}

LabelBand detect_one_label(const ElevationBand& elevations, Context& /*context*/) {
    return {elevations.shape, {}};
}

}  // namespace d2b::detect
