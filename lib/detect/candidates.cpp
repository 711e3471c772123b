#include "detect/candidates.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "core/grid.hpp"
#include "detect/surface_quality.hpp"
#include "detect/tree_crowns.hpp"
#include "raster/morphology.hpp"

namespace d2b::detect {
namespace {

constexpr std::int32_t cells_beside = 2;
constexpr double blurred_below = 0.5;

/// Returns the cells of a mask whose four neighbours belong to it as well.
Mask inside_of(const Mask& cells, Executor& threads) {
    Mask inside = Mask::unset(cells.rows, cells.cols, threads);
    for_rows(threads, cells.rows, cells.cols, [&](std::int32_t row) {
        const std::span<std::uint8_t> out = inside.row(row);
        if (row == 0 || row + 1 == cells.rows) {
            std::fill(out.begin(), out.end(), std::uint8_t{0});
            return;
        }
        const std::span<const std::uint8_t> here = cells.row(row);
        const std::span<const std::uint8_t> above = cells.row(row - 1);
        const std::span<const std::uint8_t> below = cells.row(row + 1);
        for (std::size_t c = 1; c + 1 < out.size(); ++c)
            out[c] = here[c] & here[c - 1] & here[c + 1] & above[c] & below[c];
        out.front() = out.back() = 0;
    });
    return inside;
}

/// True if a cell is less than half as high as the nearby inner cells on average.
bool is_blurred(const Scene& scene, const Mask& inside, std::int32_t row, std::int32_t col) {
    double sum = 0;
    int count = 0;
    const std::int32_t left = std::max(col - cells_beside, 0);
    const std::int32_t right = std::min(col + cells_beside, inside.cols - 1);
    for (std::int32_t r = std::max(row - cells_beside, 0); r <= std::min(row + cells_beside, inside.rows - 1);
         ++r) {
        const std::uint8_t* const within = inside.row(r).data();
        const float* const z = scene.surface.row(r).data();
        const float* const ground = scene.terrain.row(r).data();
        for (std::int32_t c = left; c <= right; ++c)
            if (within[c] != 0) {
                sum += static_cast<double>(z[c] - ground[c]);
                ++count;
            }
    }
    return static_cast<double>(scene.height(inside.index(row, col))) * count < blurred_below * sum;
}

constexpr double opening_m = 1.5;
// Restores the cells that an opening rounds off at a right angle.
constexpr int border_cells = 3;
constexpr int border_of_blocks = 2;   // if the element is a block of cells instead of a disk
constexpr float above_roof_m = 1.2F;  // cells that stand higher beside a roof are those of a crown
// Share of neighbours in a crown that rounding makes equal, per metre of step.
constexpr double low_slope_by_rounding = 0.08;
// Bilbao, in whole metres and cells of 2.5 m, is detected as well as it is without these limits.
constexpr double coarse_step_m = 0.499;
constexpr double coarse_step = 0.499;  // share of the cell size
// Urban trees hardly reach 40 m.
constexpr float taller_than_trees_m = 50;

/// Removes rough cells with vegetation, because only smooth cells may be a green roof.
Mask exclude_vegetation(const Scene& scene, const SceneCells& cells, Executor& threads) {
    Mask elevated = Mask::unset(cells.elevated.rows, cells.elevated.cols, threads);
    for_row_bands(threads, elevated.rows, elevated.cols, [&](RowBand band) {
        for (std::size_t i = elevated.index(band.begin, 0); i < elevated.index(band.end, 0); ++i)
            elevated.values[i] =
                scene.greenness->values[i] > vegetation_ndvi && (cells.flags.values[i] & smooth_any_way) == 0
                    ? std::uint8_t{0}
                    : cells.elevated.values[i];
    });
    return elevated;
}

/// Flags rows with cells taller than trees.
std::vector<std::uint8_t> tall_rows(const Scene& scene, Executor& threads) {
    std::vector<std::uint8_t> tall(static_cast<std::size_t>(scene.surface.rows));
    for_rows(threads, scene.surface.rows, scene.surface.cols, [&](std::int32_t r) {
        const std::span<const float> z = scene.surface.row(r);
        const std::span<const float> ground = scene.terrain.row(r);
        int any = 0;
        for (std::size_t c = 0; c < z.size(); ++c)
            any |= z[c] - ground[c] > taller_than_trees_m ? 1 : 0;
        tall[static_cast<std::size_t>(r)] = static_cast<std::uint8_t>(any);
    });
    return tall;
}

/// Adds cells taller than trees, because these belong to buildings however rough they are: belfries and
/// machinery on towers.
void add_cells_taller_than_trees(const Scene& scene, std::span<const std::uint8_t> tall, const Mask& elevated,
                                 Mask& seeds, Executor& threads) {
    threads.for_each(tall.size(), [&](std::size_t row) {
        if (tall[row] == 0)
            return;
        const auto r = static_cast<std::int32_t>(row);
        for (std::size_t i = seeds.index(r, 0); i < seeds.index(r + 1, 0); ++i)
            if (elevated.values[i] != 0 && scene.height(i) > taller_than_trees_m)
                seeds.values[i] = 1;
    });
}

/// True if a cell is much higher than all cells of objects within some steps.
bool stands_above(const Scene& scene, const Mask& objects, std::int32_t row, std::int32_t col,
                  std::int32_t steps) {
    const float z = scene.surface.at(row, col);
    const std::int32_t left = std::max(col - steps, 0);
    const std::int32_t right = std::min(col + steps, objects.cols - 1);
    for (std::int32_t r = std::max(row - steps, 0); r <= std::min(row + steps, objects.rows - 1); ++r)
        for (std::int32_t c = left; c <= right; ++c)
            if (objects.at(r, c) != 0 && z <= scene.surface.at(r, c) + above_roof_m)
                return false;
    return true;
}

/// @param small receives the first cells of objects that are too small
ObjectRegions object_regions(const Scene& scene, const SceneCells& known, const Mask& elevated,
                             const SmoothSegments& segments, std::int64_t min_cells,
                             std::vector<FirstCell>& small, Executor& threads) {
    Mask seeds = mask_of(segments.regions, threads);
    add_cells_taller_than_trees(scene, known.tall_rows, elevated, seeds, threads);
    Mask cells = grow_by_majority(std::move(seeds), elevated, scene.cell, threads);
    cells = open_mask(cells, opening_m, scene.cell, threads);
    cells = grow_border(scene, std::move(cells), elevated, threads);
    cells = smooth_border(cells, elevated, scene.cell, threads);
    remove_blurred_edge(scene, cells, threads);
    Regions regions = connected_regions(cells, 1, 0, threads);
    small = remove_small(regions, min_cells);
    cells = mask_of(regions, threads);
    fill_small_holes(cells, cells_covering(smallest_hole_m2, scene.cell), threads);
    regions = connected_regions(cells, 1, 0, threads);
    return {std::move(cells), std::move(regions)};
}

}  // namespace

Mask grow_border(const Scene& scene, Mask objects, const Mask& elevated, Executor& threads) {
    if (!disk_fits(opening_m, scene.cell))
        return dilate_within(std::move(objects), elevated, border_of_blocks, threads);
    const Mask grown = dilate_within(objects, elevated, border_cells, threads);
    Mask roofs = grown;
    for_row_bands(threads, roofs.rows, roofs.cols, [&](RowBand band) {
        std::vector<std::uint8_t> added(static_cast<std::size_t>(roofs.cols));
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            std::ranges::transform(grown.row(r), objects.row(r), added.begin(), std::bit_xor<>());
            for_mask_runs(added, 1, [&](std::int32_t begin, std::int32_t end) {
                for (std::int32_t c = begin; c < end; ++c)
                    if (stands_above(scene, objects, r, c, border_cells))
                        roofs.at(r, c) = 0;
            });
        }
    });
    return dilate_within(std::move(objects), roofs, border_cells, threads);
}

void remove_blurred_edge(const Scene& scene, Mask& cells, Executor& threads) {
    const Mask inside = inside_of(cells, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        std::vector<std::uint8_t> border(static_cast<std::size_t>(cells.cols));
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::span<std::uint8_t> here = cells.row(row);
            const std::span<const std::uint8_t> within = inside.row(row);
            std::uint8_t* const out = border.data();
            for (std::size_t c = 0; c < here.size(); ++c)
                out[c] = here[c] ^ within[c];  // inner cells are cells, too
            for_mask_runs(border, 1, [&](std::int32_t begin, std::int32_t end) {
                for (std::int32_t col = begin; col < end; ++col)
                    if (is_blurred(scene, inside, row, col))
                        here[static_cast<std::size_t>(col)] = 0;
            });
        }
    });
}

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
    quality.filled = interpolated_fraction(scene.surface, cells.elevated, cells.flags, threads);
    return quality;
}

void flag_cells(const Scene& scene, const SurfaceQuality& quality, SceneCells& cells, Executor& threads) {
    const SmoothnessThresholds limits = smoothness_thresholds(scene.side(), quality);
    if (cells.limits == limits)
        return;
    cells.flags = {};  // frees the memory before the new flags are allocated
    cells.flags = smoothness(scene.surface, limits, threads);
    cells.limits = limits;
}

ObjectsWithCrowns find_objects(const Scene& scene, SceneCells& cells, double min_area_m2,
                               const SurfaceQuality& quality, Executor& threads) {
    flag_cells(scene, quality, cells, threads);
    std::optional<Mask> without_plants;
    if (scene.greenness != nullptr)
        without_plants = exclude_vegetation(scene, cells, threads);
    const Mask& elevated = without_plants ? *without_plants : cells.elevated;
    ObjectsWithCrowns result;
    result.segments = smooth_segments(scene, elevated, cells.flags, threads);
    Candidates& objects = result.objects;
    ObjectRegions found =
        object_regions(scene, cells, elevated, result.segments, cells_covering(min_area_m2, scene.cell),
                       objects.rejected.small, threads);
    objects.features = compute_features(scene, found, result.segments, cells.flags, threads);
    for (ObjectFeatures& features : objects.features) {
        if (quality.rounded_to > 0)
            features.low_slope_ratio -= low_slope_by_rounding * quality.rounded_to;
        objects.objects.push_back(classify(features, quality.uninformative_share()));
        objects.objects.back().cells = found.regions.cells[objects.objects.size()];
    }
    objects.regions = std::move(found.regions);
    result.cells = std::move(found.cells);
    return result;
}

Candidates cut_crowns(const Scene& scene, const Grid<std::uint8_t>& flags, double min_area_m2,
                      ObjectsWithCrowns found, Executor& threads) {
    found.objects.rejected.crowns =
        remove_attached_crowns(scene, found.segments, flags, cells_covering(min_area_m2, scene.cell),
                               std::move(found.cells), found.objects, threads);
    return std::move(found.objects);
}

Candidates find_candidates(const Scene& scene, SceneCells& cells, double min_area_m2,
                           const SurfaceQuality& quality, Executor& threads) {
    ObjectsWithCrowns found = find_objects(scene, cells, min_area_m2, quality, threads);
    return cut_crowns(scene, cells.flags, min_area_m2, std::move(found), threads);
}

}  // namespace d2b::detect
