#include "detect/detection.hpp"

#include <cmath>
#include <utility>

#include "detect/evidence.hpp"
#include "detect/holes.hpp"
#include "detect/majority.hpp"
#include "detect/morphology.hpp"
#include "detect/noise.hpp"
#include "detect/regions.hpp"
#include "detect/segments.hpp"
#include "detect/smoothness.hpp"
#include "detect/split.hpp"

namespace d2b {
namespace {

constexpr double opening_m = 1.5;
constexpr int border_cells = 3;
constexpr double smallest_hole_m2 = 10;

std::int64_t cells_of(double area_m2, const Scene& scene) {
    return static_cast<std::int64_t>(std::ceil(area_m2 / scene.cell_area()));
}

/// Where plants are known to be, only what is smooth may be a roof.
void leave_plants_out(const Scene& scene, const Grid<std::uint8_t>& flags, Mask& elevated) {
    if (scene.greenness == nullptr)
        return;
    for (std::size_t i = 0; i < elevated.size(); ++i)
        if (scene.greenness->values[i] > plants_ndvi && (flags.values[i] & smooth_any_way) == 0)
            elevated.values[i] = 0;
}

DetectedObjects find_objects(const Scene& scene, const Mask& elevated, const SmoothSegments& segments,
                             std::int64_t least_cells) {
    Mask cells = grow_by_majority(mask_of(segments.regions), elevated, scene.cell);
    cells = grown(opened(std::move(cells), opening_m, scene.cell), elevated, border_cells);
    cells = smooth_border(cells, elevated, scene.cell);
    Regions large = connected_regions(cells);
    drop_small(large, least_cells);
    cells = mask_of(large);
    fill_small_holes(cells, cells_of(smallest_hole_m2, scene));
    Regions regions = connected_regions(cells);
    return {std::move(cells), std::move(regions)};
}

/// Objects and what is thought of them.
struct Judged {
    Regions regions;
    std::vector<DetectedObject> objects;
};

Judged judged_objects(const Scene& scene, const DetectOptions& options) {
    Mask elevated = elevated_cells(scene, options.min_height);
    const Grid<std::uint8_t> flags =
        smoothness(scene.surface, scene.side(), estimate_noise(scene.surface, elevated));
    leave_plants_out(scene, flags, elevated);
    const SmoothSegments segments = smooth_segments(scene, elevated, flags);
    DetectedObjects found = find_objects(scene, elevated, segments, cells_of(options.min_area_m2, scene));
    Judged result;
    for (const Evidence& evidence : collect_evidence(scene, found, segments, flags)) {
        result.objects.push_back(judge(evidence));
        result.objects.back().cells = found.regions.cells[result.objects.size()];
    }
    result.regions = std::move(found.regions);
    return result;
}

/// Buildings first, then what is doubtful, each in scan order.
Detection sorted_by_confidence(const Judged& judged, double least) {
    Detection result;
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
    result.labels = label_grid(judged.regions, number);
    return result;
}

}  // namespace

Detection detect_buildings(const Scene& scene, const DetectOptions& options, Context& /*context*/) {
    Detection result = sorted_by_confidence(judged_objects(scene, options), options.min_confidence);
    if (options.split_height > 0)
        split_buildings(scene, options.split_height, cells_of(options.min_area_m2, scene), result);
    return result;
}

}  // namespace d2b
