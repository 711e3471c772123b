#include "detect/judged_objects.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
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
#include "detect/value_step.hpp"

namespace d2b {
namespace {

constexpr double opening_m = 1.5;
// Restores the cells that an opening rounds off at a right angle.
constexpr int border_cells = 3;
constexpr int border_of_blocks = 2;  // if the element is a block of cells instead of a disk
constexpr double smallest_hole_m2 = 10;
// Share of neighbours in a crown that rounding makes equal, per metre of step.
constexpr double gentle_by_rounding = 0.08;
// Bilbao, in whole metres and cells of 2.5 m, is detected as well as it is without these limits.
constexpr double coarse_step_m = 0.499;
constexpr double coarse_step = 0.499;  // share of the cell size
// Urban trees hardly reach 40 m.
constexpr float taller_than_trees_m = 50;

/// Removes rough cells with vegetation, because only smooth cells may be a green roof.
Mask leave_plants_out(const Scene& scene, const SceneCells& cells, Executor& threads) {
    Mask elevated = Mask::unset(cells.elevated.rows, cells.elevated.cols, threads);
    for_row_bands(threads, elevated.rows, elevated.cols, [&](RowBand band) {
        for (std::size_t i = elevated.index(band.begin, 0); i < elevated.index(band.end, 0); ++i)
            elevated.values[i] =
                scene.greenness->values[i] > plants_ndvi && (cells.flags.values[i] & smooth_any_way) == 0
                    ? std::uint8_t{0}
                    : cells.elevated.values[i];
    });
    return elevated;
}

/// Flags rows with cells taller than trees.
std::vector<std::uint8_t> tall_rows(const Scene& scene, Executor& threads) {
    std::vector<std::uint8_t> tall(static_cast<std::size_t>(scene.surface.rows));
    for_row_bands(threads, scene.surface.rows, scene.surface.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const std::span<const float> z = scene.surface.row(r);
            const std::span<const float> ground = scene.terrain.row(r);
            int any = 0;
            for (std::size_t c = 0; c < z.size(); ++c)
                any |= z[c] - ground[c] > taller_than_trees_m ? 1 : 0;
            tall[static_cast<std::size_t>(r)] = static_cast<std::uint8_t>(any);
        }
    });
    return tall;
}

/// Adds cells taller than trees, because these belong to buildings however rough they are: belfries and
/// machinery on towers.
void add_what_is_too_tall_for_trees(const Scene& scene, std::span<const std::uint8_t> tall,
                                    const Mask& elevated, Mask& seeds, Executor& threads) {
    threads.for_each(tall.size(), [&](std::size_t row) {
        if (tall[row] == 0)
            return;
        const auto r = static_cast<std::int32_t>(row);
        for (std::size_t i = seeds.index(r, 0); i < seeds.index(r + 1, 0); ++i)
            if (elevated.values[i] != 0 && scene.height(i) > taller_than_trees_m)
                seeds.values[i] = 1;
    });
}

/// @param small receives the first cells of objects that are too small
DetectedObjects find_objects(const Scene& scene, const SceneCells& known, const Mask& elevated,
                             const SmoothSegments& segments, std::int64_t least_cells,
                             std::vector<FirstCell>& small, Executor& threads) {
    Mask seeds = mask_of(segments.regions, threads);
    add_what_is_too_tall_for_trees(scene, known.tall_rows, elevated, seeds, threads);
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

/// Computes the flags for a quality unless they are up to date.
void flag_cells(const Scene& scene, const SurfaceQuality& quality, SceneCells& cells, Executor& threads) {
    const SmoothLimits limits = smooth_limits(scene.side(), quality);
    if (cells.limits == limits)
        return;
    cells.flags = {};  // frees the memory before the new flags are allocated
    cells.flags = smoothness(scene.surface, limits, threads);
    cells.limits = limits;
}

}  // namespace

SceneCells scene_cells(const Scene& scene, const DetectOptions& options, Executor& threads) {
    return {elevated_cells(scene, options.min_height, threads), tall_rows(scene, threads), {}, {}};
}

SurfaceQuality surface_quality(const Scene& scene, SceneCells& cells, Executor& threads) {
    SurfaceQuality quality;
    const double step = value_step(scene.surface, threads).value_or(0);
    if (step >= coarse_step_m && step >= coarse_step * scene.side())
        quality.rounded_to = step;
    quality.noise = std::max(surface_noise(scene.surface, cells.elevated, threads), rounding_noise(step));
    flag_cells(scene, quality, cells, threads);
    quality.filled = filled_share(scene.surface, cells.elevated, cells.flags, threads);
    return quality;
}

JudgedObjects judged_objects(const Scene& scene, SceneCells& cells, double smallest_m2,
                             const SurfaceQuality& quality, Executor& threads, LeaningCrowns crowns) {
    flag_cells(scene, quality, cells, threads);
    const Grid<std::uint8_t>& flags = cells.flags;
    std::optional<Mask> without_plants;
    if (scene.greenness != nullptr)
        without_plants = leave_plants_out(scene, cells, threads);
    const Mask& elevated = without_plants ? *without_plants : cells.elevated;
    const SmoothSegments segments = smooth_segments(scene, elevated, flags, threads);
    const std::int64_t least = cells_for(smallest_m2, scene.cell);
    JudgedObjects result;
    DetectedObjects found =
        find_objects(scene, cells, elevated, segments, least, result.left_out.small, threads);
    result.evidence = collect_evidence(scene, found, segments, flags, threads);
    for (Evidence& evidence : result.evidence) {
        if (quality.rounded_to > 0)
            evidence.gentle -= gentle_by_rounding * quality.rounded_to;
        result.objects.push_back(judge(evidence, quality.unseen()));
        result.objects.back().cells = found.regions.cells[result.objects.size()];
    }
    result.regions = std::move(found.regions);
    if (crowns == LeaningCrowns::are_cut_off)
        result.left_out.crowns =
            take_crowns_off(scene, segments, flags, least, std::move(found.cells), result, threads);
    return result;
}

}  // namespace d2b
