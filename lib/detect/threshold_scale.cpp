#include "detect/threshold_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>

#include "core/grid.hpp"
#include "detect/priors.hpp"
#include "detect/slope_sampling.hpp"
#include "raster/morphology.hpp"

namespace d2b::detect {
namespace {

constexpr std::int32_t near = 1;  // cells
constexpr std::int32_t far = 3;

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
    std::int64_t cells;  ///< of a mask
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

std::int64_t cells_in(const Mask& mask, const Square& square) {
    std::int64_t cells = 0;
    for (std::int32_t r = square.row; r < square.row + square.rows; ++r) {
        const auto begin = mask.row(r).begin() + square.col;
        cells = std::accumulate(begin, begin + square.cols, cells);
    }
    return cells;
}

std::vector<Square> squares_of(const Mask& mask) {
    std::vector<Square> squares;
    for (std::int32_t r = 0; r < mask.rows; r += square_cells)
        for (std::int32_t c = 0; c < mask.cols; c += square_cells) {
            Square square{r, c, std::min(square_cells, mask.rows - r), std::min(square_cells, mask.cols - c),
                          0};
            square.cells = cells_in(mask, square);
            if (square.cells > 0)
                squares.push_back(square);
        }
    return squares;
}

/// Returns the elevated cells that are smooth, which most cells of crowns are not.
Mask smooth_cells(const SceneCells& cells, Executor& threads) {
    Mask smooth = Mask::unset(cells.elevated.rows, cells.elevated.cols, threads);
    for_cells(threads, smooth, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            smooth.values[i] =
                cells.elevated.values[i] & ((cells.flags.values[i] & smooth_any_way) != 0 ? 1 : 0);
    });
    return smooth;
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

/// Sample with the candidates that the unchanged thresholds find in it.
struct Trial {
    const SceneSample& sample;
    SceneCells cells;
    Candidates usual;
    Mask roofs;               ///< cells of certain roofs
    std::int64_t common = 0;  ///< of these: within likely buildings
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

double StepFalls::sharpness() const {
    return within_far > 0 ? static_cast<double>(within_near) / static_cast<double>(within_far) : 1;
}

StepFalls step_falls(const MetreGrid& surface, const Mask& objects, Executor& threads) {
    const auto add_band = [&](RowBand band, StepFalls& falls) {
        for (std::int32_t r = std::max(band.begin, 1); r < std::min(band.end, objects.rows - 1); ++r)
            for (std::int32_t c = 1; c + 1 < objects.cols; ++c)
                if (objects.at(r, c) != 0 && has_free_side(objects, r, c) && !std::isnan(surface.at(r, c))) {
                    falls.within_near += fall(surface, r, c, near);
                    falls.within_far += fall(surface, r, c, far);
                }
    };
    return reduce_row_bands(threads, objects.rows, objects.cols, StepFalls(), add_band);
}

std::vector<SceneSample> scene_samples(const Scene& scene, const Mask& cells, Executor& threads) {
    std::vector<Square> squares = squares_of(cells);
    std::ranges::stable_sort(squares, std::ranges::greater{}, &Square::cells);
    squares.resize(std::min(squares.size(), most_samples));
    std::vector<SceneSample> samples(squares.size());
    threads.for_each(squares.size(), [&](std::size_t i) {
        const Square& square = squares[i];
        samples[i] = {cut(scene.surface, square, threads), cut(scene.terrain, square, threads), scene.cell,
                      cut(scene.allowed, square, threads), cut(scene.greenness, square, threads)};
    });
    return samples;
}

double estimate_threshold_scale(const Scene& scene, const SceneCells& cells, const DetectOptions& options,
                                double min_area_m2, const SurfaceQuality& quality, Executor& threads) {
    const std::vector<double> stricter = stricter_scales(scene.side(), quality.filled);
    if (stricter.empty())
        return 1;
    // Crowns at walls are not cut off when scales are compared, because stricter thresholds show their
    // worth by taking crowns away.
    const auto find_at = [&](double factor, Trial& trial) {
        SurfaceQuality other = quality;
        other.threshold_scale = factor;
        return find_objects(trial.sample.scene(), trial.cells, min_area_m2, other, threads);
    };
    const std::vector<SceneSample> samples = scene_samples(scene, smooth_cells(cells, threads), threads);
    std::vector<Trial> trials;
    trials.reserve(samples.size());
    std::vector<DetectedObject> all;
    StepFalls falls;
    SlopeErrors slopes;
    std::int64_t objects = 0;
    std::int64_t roofs = 0;
    for (const SceneSample& sample : samples) {
        const Scene part = sample.scene();
        Trial& trial = trials.emplace_back(Trial{sample, scene_cells(part, options, threads), {}, {}});
        ObjectsWithCrowns found = find_at(1, trial);
        trial.usual = found.objects;
        const Mask buildings = likely_roofs(trial.usual, threads);
        const Candidates cut = cut_crowns(part, trial.cells.flags, min_area_m2, std::move(found), threads);
        all.insert(all.end(), cut.objects.begin(), cut.objects.end());
        const Mask sure = sure_roofs(cut, quality.uninformative_share(), threads);
        falls.merge(step_falls(sample.surface, sure, threads));
        slopes.merge(slope_errors(part, likely_roofs(cut, threads), threads));
        trial.roofs = erode(sure, inside_m, scene.cell, threads);
        trial.common = common_cells(trial.roofs, buildings);
        roofs += trial.common;
        objects += common_cells(buildings, buildings);
    }
    const std::optional<SlopeSampling> sampling = slopes.sampling();
    if (roofs < fewest_roofs || !has_usual_appearance(all) || falls.sharpness() < least_sharp ||
        (sampling && has_sparse_slopes(*sampling)))
        return 1;
    const auto gain_of = [&](double factor) {
        std::int64_t gained = 0;
        std::int64_t lost_roofs = 0;
        for (Trial& trial : trials) {
            const Mask left = likely_roofs(find_at(factor, trial).objects, threads);
            gained += gained_cells(trial, left);
            lost_roofs += trial.common - common_cells(trial.roofs, left);
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
