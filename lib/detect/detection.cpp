#include "detect/detection.hpp"

#include <utility>

#include "core/row_bands.hpp"
#include "detect/evidence.hpp"
#include "detect/holes.hpp"
#include "detect/left_out.hpp"
#include "detect/majority.hpp"
#include "detect/morphology.hpp"
#include "detect/regions.hpp"
#include "detect/smooth_segments.hpp"
#include "detect/smoothness.hpp"
#include "detect/split.hpp"
#include "detect/surface_noise.hpp"

namespace d2b {
namespace {

constexpr double opening_m = 1.5;
constexpr int border_cells = 3;
constexpr double smallest_hole_m2 = 10;

/// Where plants are known to be, only what is smooth may be a roof.
void leave_plants_out(const Scene& scene, const Grid<std::uint8_t>& flags, Mask& elevated,
                      Executor& threads) {
    if (scene.greenness == nullptr)
        return;
    for_row_bands(threads, elevated.rows, elevated.cols, [&](RowBand band) {
        for (std::size_t i = elevated.index(band.begin, 0); i < elevated.index(band.end, 0); ++i)
            if (scene.greenness->values[i] > plants_ndvi && (flags.values[i] & smooth_any_way) == 0)
                elevated.values[i] = 0;
    });
}

/// @param small gets the rows of the first cells of what is too small
DetectedObjects find_objects(const Scene& scene, const Mask& elevated, const SmoothSegments& segments,
                             std::int64_t least_cells, std::vector<std::int32_t>& small, Executor& threads) {
    Mask cells = grow_by_majority(mask_of(segments.regions, threads), elevated, scene.cell, threads);
    cells = opened(cells, opening_m, scene.cell, threads);
    cells = grown(std::move(cells), elevated, border_cells, threads);
    cells = smooth_border(cells, elevated, scene.cell, threads);
    Regions regions = connected_regions(cells, 1, 0, threads);
    small = take_small_out(regions, least_cells);
    cells = mask_of(regions, threads);
    fill_small_holes(cells, cells_for(smallest_hole_m2, scene.cell), threads);
    regions = connected_regions(cells, 1, 0, threads);
    return {std::move(cells), std::move(regions)};
}

/// Objects and what is thought of them.
struct Judged {
    Regions regions;
    std::vector<DetectedObject> objects;
    LeftOut left_out;
};

Judged judged_objects(const Scene& scene, const DetectOptions& options, double smallest_m2,
                      Executor& threads) {
    Mask elevated = elevated_cells(scene, options.min_height, threads);
    const double noise = surface_noise(scene.surface, elevated, threads);
    const Grid<std::uint8_t> flags = smoothness(scene.surface, scene.side(), noise, threads);
    leave_plants_out(scene, flags, elevated, threads);
    const SmoothSegments segments = smooth_segments(scene, elevated, flags, threads);
    const std::int64_t least = cells_for(smallest_m2, scene.cell);
    Judged result;
    result.left_out.low = low_roofs(scene, flags, options.min_height, least, threads);
    DetectedObjects found = find_objects(scene, elevated, segments, least, result.left_out.small, threads);
    for (const Evidence& evidence : collect_evidence(scene, found, segments, flags, threads)) {
        result.objects.push_back(judge(evidence));
        result.objects.back().cells = found.regions.cells[result.objects.size()];
    }
    result.regions = std::move(found.regions);
    return result;
}

/// Buildings first, then what is doubtful, each in scan order.
Detection sorted_by_confidence(Judged&& judged, double least, Executor& threads) {
    Detection result;
    result.left_out = std::move(judged.left_out);
    std::vector<Label> number(judged.regions.cells.size(), 0);
    for (const bool sure : {true, false}) {
        for (std::size_t i = 0; i < judged.objects.size(); ++i)
            if ((judged.objects[i].confidence >= least) == sure) {
                result.objects.push_back(judged.objects[i]);
                number[i + 1] = static_cast<Label>(result.objects.size());
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
    Detection result = sorted_by_confidence(judged_objects(scene, options, smallest_m2, threads),
                                            options.min_confidence, threads);
    if (options.split_height > 0)
        split_buildings(scene, options.split_height, cells_for(smallest_m2, scene.cell), result, threads);
    return result;
}

}  // namespace d2b
