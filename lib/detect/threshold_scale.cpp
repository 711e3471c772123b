#include "detect/threshold_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "core/grid.hpp"
#include "detect/priors.hpp"
#include "raster/morphology.hpp"

namespace d2b::detect {
namespace {

constexpr std::int32_t near = 1;  // cells
constexpr std::int32_t far = 3;

/// Sums over all border cells in mm.
struct Falls {
    std::int64_t within_near = 0;
    std::int64_t within_far = 0;

    void merge(const Falls& other) {
        within_near += other.within_near;
        within_far += other.within_far;
    }
};

bool has_free_side(const Mask& cells, std::int32_t r, std::int32_t c) {
    return cells.at(r - 1, c) == 0 || cells.at(r + 1, c) == 0 || cells.at(r, c - 1) == 0 ||
           cells.at(r, c + 1) == 0;
}

/// Returns the fall in mm to the lowest cell within a square, at most 10 km, because sums of values that are
/// no elevations would overflow. Cells without data are ignored.
std::int64_t fall(const MetreGrid& surface, std::int32_t r, std::int32_t c, std::int32_t reach) {
    const float here = surface.at(r, c);
    float lowest = here;
    for (std::int32_t y = std::max(r - reach, 0); y <= std::min(r + reach, surface.rows - 1); ++y)
        for (std::int32_t x = std::max(c - reach, 0); x <= std::min(c + reach, surface.cols - 1); ++x)
            lowest = std::min(lowest, surface.at(y, x));  // unchanged if the other one is NaN
    constexpr float highest = 10000;
    return std::llround(1000 * static_cast<double>(std::min(here - lowest, highest)));
}

constexpr std::int32_t square_cells = 1024;
constexpr std::size_t most_samples = 4;

struct Square {
    std::int32_t row;
    std::int32_t col;
    std::int32_t rows;
    std::int32_t cols;
    std::int64_t roofs;  ///< cells
};

template <typename T>
Grid<T> cut(const Grid<T>& grid, const Square& square, Executor& threads) {
    auto part = Grid<T>::unset(square.rows, square.cols, threads);
    for (std::int32_t r = 0; r < square.rows; ++r)
        std::copy_n(grid.row(square.row + r).begin() + square.col, square.cols, part.row(r).begin());
    return part;
}

template <typename T>
std::optional<Grid<T>> cut(const Grid<T>* grid, const Square& square, Executor& threads) {
    return grid != nullptr ? std::optional(cut(*grid, square, threads)) : std::nullopt;
}

std::int64_t roofs_in(const Mask& roofs, const Square& square) {
    std::int64_t cells = 0;
    for (std::int32_t r = square.row; r < square.row + square.rows; ++r) {
        const auto begin = roofs.row(r).begin() + square.col;
        cells = std::accumulate(begin, begin + square.cols, cells);
    }
    return cells;
}

std::vector<Square> squares_of(const Mask& roofs) {
    std::vector<Square> squares;
    for (std::int32_t r = 0; r < roofs.rows; r += square_cells)
        for (std::int32_t c = 0; c < roofs.cols; c += square_cells) {
            Square square{r, c, std::min(square_cells, roofs.rows - r),
                          std::min(square_cells, roofs.cols - c), 0};
            square.roofs = roofs_in(roofs, square);
            if (square.roofs > 0)
                squares.push_back(square);
        }
    return squares;
}

constexpr double surely_roof = 0.95;
constexpr double likely_roof = 0.5;
constexpr double inside_m = 1;
constexpr std::int64_t fewest_roofs = 500;  // cells
// Laser scans with cells of 0.5 to 2.5 m have 0.7 to 1; the town of docs/accuracy.md as seen by satellites
// has 0.5.
constexpr double least_sharp = 0.6;
constexpr double equally_good = 0.9;       // of the best gain, ...
constexpr double negligible_gain = 0.002;  // ... or less by this share of the objects
constexpr double hopeless_gain = -0.01;    // even stricter limits lose more

/// Returns roofs that are certain even without their right angles, because the surface alone has to show its
/// smoothness.
Mask sure_roofs(const Candidates& judged, double filled, Executor& threads) {
    const auto is_sure = [&](Label label) {
        ObjectFeatures without = judged.features[label - 1];
        without.right_angles = neutral_right_angles;
        return judged.objects[label - 1].confidence > surely_roof &&
               classify(without, filled).confidence > surely_roof;
    };
    return mask_of(judged.regions, is_sure, threads);
}

Mask likely_roofs(const Candidates& judged, Executor& threads) {
    const auto is_likely = [&](Label label) { return judged.objects[label - 1].confidence > likely_roof; };
    return mask_of(judged.regions, is_likely, threads);
}

std::int64_t common_cells(const Mask& a, const Mask& b) {
    return std::inner_product(a.values.begin(), a.values.end(), b.values.begin(), std::int64_t{0});
}

/// Sample with the candidates that the unchanged thresholds find in it. These are found anew, because objects
/// cut by the border of a sample may not be found at all.
struct Trial {
    const RoofSample& sample;
    SceneCells cells;
    Candidates usual;
    std::int64_t roofs = 0;  ///< cells of certain roofs that these find
};

/// Cells that likely buildings of a trial lose, less those of objects that are certain and mostly lost.
std::int64_t gained_cells(const Trial& trial, const Mask& left) {
    const Regions& regions = trial.usual.regions;
    std::vector<std::int64_t> remaining(trial.usual.objects.size(), 0);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            std::int64_t& cells = remaining[run.label - 1];
            const auto begin = left.row(r).begin();
            cells = std::accumulate(begin + run.begin, begin + run.end, cells);
        }
    std::int64_t gained = 0;
    for (std::size_t i = 0; i < remaining.size(); ++i) {
        const DetectedObject& object = trial.usual.objects[i];
        const std::int64_t lost = object.cells - remaining[i];
        if (object.confidence > likely_roof)
            gained += object.confidence > surely_roof && lost > remaining[i] ? -lost : lost;
    }
    return gained;
}

}  // namespace

double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads) {
    const auto add_band = [&](RowBand band, Falls& falls) {
        for (std::int32_t r = std::max(band.begin, 1); r < std::min(band.end, objects.rows - 1); ++r)
            for (std::int32_t c = 1; c + 1 < objects.cols; ++c)
                if (objects.at(r, c) != 0 && has_free_side(objects, r, c) && !std::isnan(surface.at(r, c))) {
                    falls.within_near += fall(surface, r, c, near);
                    falls.within_far += fall(surface, r, c, far);
                }
    };
    const Falls all = reduce_row_bands(threads, objects.rows, objects.cols, Falls(), add_band);
    return all.within_far > 0 ? static_cast<double>(all.within_near) / static_cast<double>(all.within_far)
                              : 1;
}

std::vector<RoofSample> roof_samples(const Scene& scene, const Mask& roofs, Executor& threads) {
    std::vector<Square> squares = squares_of(roofs);
    std::stable_sort(squares.begin(), squares.end(),
                     [](const Square& a, const Square& b) { return a.roofs > b.roofs; });
    squares.resize(std::min(squares.size(), most_samples));
    std::vector<RoofSample> samples(squares.size());
    threads.for_each(squares.size(), [&](std::size_t i) {
        const Square& square = squares[i];
        samples[i] = {cut(scene.surface, square, threads),
                      cut(scene.terrain, square, threads),
                      scene.cell,
                      cut(scene.allowed, square, threads),
                      cut(scene.greenness, square, threads),
                      cut(roofs, square, threads)};
    });
    return samples;
}

std::optional<double> estimate_threshold_scale(const Scene& scene, const DetectOptions& options,
                                               double min_area_m2, const SurfaceQuality& quality,
                                               const Candidates& first, Executor& threads) {
    const Mask buildings = sure_roofs(first, quality.uninformative_share(), threads);
    const std::vector<double> stricter = stricter_scales(scene.side(), quality.filled);
    if (stricter.empty() || !has_usual_appearance(first.objects) ||
        step_sharpness(scene.surface, buildings, threads) < least_sharp)
        return std::nullopt;
    const std::optional<SlopeSampling> slopes = slope_sampling(scene, likely_roofs(first, threads), threads);
    if (slopes && has_sparse_slopes(*slopes))
        return std::nullopt;
    const auto find_at = [&](double factor, Trial& trial) {
        SurfaceQuality other = quality;
        other.threshold_scale = factor;
        return find_candidates(trial.sample.scene(), trial.cells, min_area_m2, other, threads,
                               CrownTreatment::keep);
    };
    const std::vector<RoofSample> samples =
        roof_samples(scene, erode(buildings, inside_m, scene.cell, threads), threads);
    std::vector<Trial> trials;
    std::int64_t objects = 0;
    std::int64_t roofs = 0;
    for (const RoofSample& sample : samples) {
        Trial& trial = trials.emplace_back(Trial{sample, scene_cells(sample.scene(), options, threads), {}});
        trial.usual = find_at(1, trial);
        const Mask found = likely_roofs(trial.usual, threads);
        trial.roofs = common_cells(sample.roofs, found);
        roofs += trial.roofs;
        objects += common_cells(found, found);
    }
    if (roofs < fewest_roofs)
        return std::nullopt;
    const auto gain_of = [&](double factor) {
        std::int64_t gained = 0;
        std::int64_t lost_roofs = 0;
        for (Trial& trial : trials) {
            const Mask left = likely_roofs(find_at(factor, trial), threads);
            gained += gained_cells(trial, left);
            lost_roofs += trial.roofs - common_cells(trial.sample.roofs, left);
        }
        return static_cast<double>(gained) / static_cast<double>(objects) -
               price_of_lost_roofs(quality.filled) * static_cast<double>(lost_roofs) /
                   static_cast<double>(roofs);
    };
    double best = 0;
    double scale = 1;
    for (const double factor : stricter) {
        const double gain = gain_of(factor);
        if (gain < hopeless_gain)
            break;
        if (gain >= equally_good * best - negligible_gain)
            scale = factor;
        best = std::max(best, gain);
    }
    return scale;
}

}  // namespace d2b::detect
