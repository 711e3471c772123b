#include "detect/judged_objects.hpp"

#include <cstdint>
#include <utility>

#include "core/row_bands.hpp"
#include "detect/attached_crowns.hpp"
#include "detect/element.hpp"
#include "detect/evidence.hpp"
#include "detect/filled_share.hpp"
#include "detect/holes.hpp"
#include "detect/majority.hpp"
#include "detect/morphology.hpp"
#include "detect/smeared_border.hpp"
#include "detect/smooth_segments.hpp"
#include "detect/surface_noise.hpp"

namespace d2b {
namespace {

constexpr double opening_m = 1.5;
// What an opening rounds off at a right angle.
constexpr int border_cells = 3;
constexpr int border_of_blocks = 2;  // where a block of cells takes the place of the disk
constexpr double smallest_hole_m2 = 10;
// Trees of towns hardly reach 40 m.
constexpr float taller_than_trees_m = 50;

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

/// What is taller than trees is a building's, however rough: belfries and the machines on towers.
void add_what_is_too_tall_for_trees(const Scene& scene, const Mask& elevated, Mask& seeds,
                                    Executor& threads) {
    for_row_bands(threads, seeds.rows, seeds.cols, [&](RowBand band) {
        for (std::size_t i = seeds.index(band.begin, 0); i < seeds.index(band.end, 0); ++i)
            if (elevated.values[i] != 0 && scene.height(i) > taller_than_trees_m)
                seeds.values[i] = 1;
    });
}

/// @param small gets the first cells of what is too small
DetectedObjects find_objects(const Scene& scene, const Mask& elevated, const SmoothSegments& segments,
                             std::int64_t least_cells, std::vector<FirstCell>& small, Executor& threads) {
    Mask seeds = mask_of(segments.regions, threads);
    add_what_is_too_tall_for_trees(scene, elevated, seeds, threads);
    Mask cells = grow_by_majority(std::move(seeds), elevated, scene.cell, threads);
    cells = opened(cells, opening_m, scene.cell, threads);
    cells = grown(std::move(cells), elevated,
                  disk_fits(opening_m, scene.cell) ? border_cells : border_of_blocks, threads);
    cells = smooth_border(cells, elevated, scene.cell, threads);
    take_smeared_border_off(scene, cells, threads);
    Regions regions = connected_regions(cells, 1, 0, threads);
    small = take_small_out(regions, least_cells);
    cells = mask_of(regions, threads);
    fill_small_holes(cells, cells_for(smallest_hole_m2, scene.cell), threads);
    regions = connected_regions(cells, 1, 0, threads);
    return {std::move(cells), std::move(regions)};
}

Grid<std::uint8_t> flags_of(const Scene& scene, const SurfaceQuality& quality, Executor& threads) {
    return smoothness(scene.surface, smooth_limits(scene.side(), quality), threads);
}

}  // namespace

SurfaceQuality surface_quality(const Scene& scene, const DetectOptions& options, Executor& threads) {
    const Mask elevated = elevated_cells(scene, options.min_height, threads);
    SurfaceQuality quality;
    quality.noise = surface_noise(scene.surface, elevated, threads);
    quality.filled = filled_share(scene.surface, elevated, flags_of(scene, quality, threads), threads);
    return quality;
}

JudgedObjects judged_objects(const Scene& scene, const DetectOptions& options, double smallest_m2,
                             const SurfaceQuality& quality, Executor& threads, LeaningCrowns crowns) {
    Mask elevated = elevated_cells(scene, options.min_height, threads);
    const Grid<std::uint8_t> flags = flags_of(scene, quality, threads);
    leave_plants_out(scene, flags, elevated, threads);
    const SmoothSegments segments = smooth_segments(scene, elevated, flags, threads);
    const std::int64_t least = cells_for(smallest_m2, scene.cell);
    JudgedObjects result;
    result.left_out.low = low_roofs(scene, flags, options.min_height, least, threads);
    DetectedObjects found = find_objects(scene, elevated, segments, least, result.left_out.small, threads);
    result.evidence = collect_evidence(scene, found, segments, flags, threads);
    for (const Evidence& evidence : result.evidence) {
        result.objects.push_back(judge(evidence, quality.filled));
        result.objects.back().cells = found.regions.cells[result.objects.size()];
    }
    result.regions = std::move(found.regions);
    if (crowns == LeaningCrowns::are_cut_off)
        result.left_out.crowns =
            take_crowns_off(scene, segments, flags, least, std::move(found.cells), result, threads);
    return result;
}

}  // namespace d2b
