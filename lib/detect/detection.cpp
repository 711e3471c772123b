#include "detect/detection.hpp"

#include <optional>
#include <span>
#include <utility>

#include "detect/cut_by_parcels.hpp"
#include "detect/judged_objects.hpp"
#include "detect/neighbour_prior.hpp"
#include "detect/place_prior.hpp"
#include "detect/roof_strictness.hpp"
#include "detect/second_look.hpp"
#include "detect/several_limits.hpp"
#include "detect/split.hpp"

namespace d2b {
namespace {

/// Corrects confidences for the share of buildings in the scene and around each object. Objects of a second
/// pass are mostly trees, even if the first pass found all houses, so they do not serve as reference objects.
void correct_for_surroundings(const Scene& scene, double filled, JudgedObjects& judged,
                              std::optional<JudgedObjects>& second, Executor& threads) {
    const std::span<DetectedObject> others =
        second ? std::span<DetectedObject>(second->objects) : std::span<DetectedObject>();
    const SupposedShare supposed = correct_for_place(filled, judged.objects, others);
    if (!supposed.as_elsewhere)
        return;
    if (second)
        correct_for_witnesses(judged, scene.cell, supposed, *second, threads);
    correct_for_neighbours(judged.regions, scene.cell, supposed, judged.objects, threads);
}

JudgedObjects judged_as_the_data_say(const Scene& scene, const DetectOptions& options, double smallest_m2,
                                     Executor& threads) {
    SceneCells cells = scene_cells(scene, options, threads);
    SurfaceQuality quality = surface_quality(scene, cells, threads);
    JudgedObjects first = judged_objects(scene, cells, smallest_m2, quality, threads);
    quality.strictness = roof_strictness(scene, options, smallest_m2, quality, first, threads).value_or(1);
    JudgedObjects judged = quality.strictness == 1
                               ? std::move(first)
                               : judged_objects(scene, cells, smallest_m2, quality, threads);
    judged.left_out.low =
        low_roofs(scene, cells.flags, options.min_height, cells_for(smallest_m2, scene.cell), threads);
    if (deserves_several_limits(scene.side(), quality.filled))
        judged = chosen_at_several_limits(scene, cells, smallest_m2, quality, std::move(judged), threads);
    std::optional<JudgedObjects> second;
    if (deserves_second_look(quality.filled))
        second = second_look(scene, cells, smallest_m2, quality, judged.regions, threads);
    correct_for_surroundings(scene, quality.filled, judged, second, threads);
    return second ? united(std::move(judged), *second, threads) : judged;
}

/// Sorts buildings before doubtful objects, each in scan order.
Detection sorted_by_confidence(JudgedObjects&& judged, double least, Executor& threads) {
    Detection result;
    result.left_out = std::move(judged.left_out);
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

Detection detect_buildings(const Scene& scene, const DetectOptions& options, double smallest_m2,
                           Context& context) {
    Executor& threads = *context.threads;
    Detection result = sorted_by_confidence(judged_as_the_data_say(scene, options, smallest_m2, threads),
                                            options.min_confidence, threads);
    if (scene.parcels != nullptr)
        cut_by_parcels(scene, options.split_width, cells_for(smallest_m2, scene.cell), result, threads);
    if (options.split_height > 0)
        split_buildings(scene, options.split_height, cells_for(smallest_m2, scene.cell), result, threads);
    return result;
}

}  // namespace d2b
