#include "detect/detection_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/grid.hpp"
#include "detect/priors.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

std::vector<bool> max_weight_antichain(std::span<const NestedCandidate> candidates) {
    std::vector<double> within(candidates.size(), 0);  // best sum of the candidates inside each
    std::vector<bool> chosen(candidates.size(), false);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        chosen[i] = candidates[i].gain > within[i];  // and thus above 0, because an empty choice is allowed
        if (candidates[i].parent != NestedCandidate::nothing)
            within[candidates[i].parent] += std::max(candidates[i].gain, within[i]);
    }
    std::vector<bool> covered(candidates.size(), false);
    for (std::size_t i = candidates.size(); i-- > 0;) {
        const std::size_t parent = candidates[i].parent;
        covered[i] = parent != NestedCandidate::nothing && (covered[parent] || chosen[parent]);
        if (covered[i])
            chosen[i] = false;
    }
    return chosen;
}

namespace {

/// Chosen objects of a pass, by label.
using Chosen = std::vector<std::uint8_t>;

/// Gain of choosing an object.
double gain_of(const DetectedObject& object) {
    constexpr double surest = 0.999;  // confidences are clamped to this
    const double log_odds = std::log(odds(std::clamp(object.confidence, 1 - surest, surest)));
    return static_cast<double>(object.cells) * log_odds;
}

std::vector<Chosen> choose(std::span<const Candidates> passes) {
    std::vector<NestedCandidate> candidates;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const std::vector<DetectedObject>& objects = passes[i].objects;
        const std::size_t next = candidates.size() + objects.size();
        std::vector<Label> parent(objects.size() + 1, 0);
        if (i + 1 < passes.size())
            parent = containing_regions(passes[i].regions, passes[i + 1].regions);
        for (std::size_t k = 0; k < objects.size(); ++k)
            candidates.push_back({gain_of(objects[k]),
                                  parent[k + 1] == 0 ? NestedCandidate::nothing : next + parent[k + 1] - 1});
    }
    const std::vector<bool> best = max_weight_antichain(candidates);
    std::vector<Chosen> chosen;
    auto next = best.begin();
    for (const Candidates& pass : passes) {
        chosen.emplace_back(pass.objects.size() + 1);
        for (std::size_t k = 1; k < chosen.back().size(); ++k)
            chosen.back()[k] = *next++ ? 1 : 0;
    }
    return chosen;
}

/// True if a mask has a set cell in columns [begin, end) of a row. Both may exceed the grid.
bool any(const Mask& mask, std::int32_t row, std::int32_t begin, std::int32_t end) {
    if (row < 0 || row >= mask.rows)
        return false;
    const auto cells = mask.row(row);
    const auto last = cells.begin() + std::min(end, mask.cols);
    return std::find(cells.begin() + std::max(begin, 0), last, 1) != last;
}

/// Also chooses objects that neither overlap nor touch a mask.
void keep_separate(const Mask& taken, const Regions& regions, Chosen& chosen) {
    Chosen apart(chosen.size(), 1);
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        if (any(taken, r, run.begin - 1, run.end + 1) || any(taken, r - 1, run.begin, run.end) ||
            any(taken, r + 1, run.begin, run.end))
            apart[run.label] = 0;
    });
    for (std::size_t label = 1; label < chosen.size(); ++label)
        chosen[label] |= apart[label];
}

/// Merges the chosen objects. Each connected part inherits the classification of the chosen object with most
/// cells in it; the strictest pass wins ties, then the first object.
/// @param cells cells of the chosen objects
/// @param rejected objects that are part of none of these stay rejected
Candidates merge_selected(std::span<const Candidates> passes, const std::vector<Chosen>& chosen,
                          const Mask& cells, const RejectedObjects& rejected, Executor& threads) {
    Candidates result;
    result.regions = connected_regions(cells, 1, 0, threads);
    const std::size_t count = result.regions.cells.size() - 1;
    result.objects.resize(count);
    result.features.resize(count);
    std::vector<std::int64_t> most(count, 0);
    for (std::size_t i = 0; i < passes.size(); ++i)
        for (const RegionOverlap& overlap : region_overlaps(result.regions, passes[i].regions)) {
            const std::size_t part = overlap.one - 1;
            if (chosen[i][overlap.other] == 0 || overlap.cells <= most[part])
                continue;
            most[part] = overlap.cells;
            result.objects[part] = passes[i].objects[overlap.other - 1];
            result.features[part] = passes[i].features[overlap.other - 1];
        }
    for (std::size_t part = 0; part < count; ++part)
        result.objects[part].cells = result.regions.cells[part + 1];
    const auto is_in = [&](const FirstCell& cell) { return cells.at(cell.row, cell.col) != 0; };
    result.rejected = rejected;
    std::erase_if(result.rejected.small, is_in);
    std::erase_if(result.rejected.low, is_in);
    std::erase_if(result.rejected.crowns, [&](const CutCrown& crown) { return is_in(crown.first); });
    return result;
}

/// Limits of smoothness as multiples of the usual ones, and the penalty on the log-odds of their candidates.
struct Level {
    double scale;
    double margin;  ///< factor on the margin for sparse points
    double penalty;
};

// Fitted on La Rochelle, on simulated sparse scans of high-resolution places, and on scenes, see
// docs/research/sparse_points.md.
constexpr std::array<Level, 5> levels{
    {{0.5, 0.5, 0}, {0.7, 0.7, 0}, {1, 1, 0}, {1.4, 1.4, 1.1}, {1, 3, 0.85}}};
constexpr std::size_t regular_level = 2;

Candidates found_at(const Level& level, const Scene& scene, SceneCells& cells, double min_area_m2,
                    SurfaceQuality quality, Executor& threads) {
    quality.threshold_scale *= level.scale;
    quality.margin_scale *= level.margin;
    Candidates judged = find_candidates(scene, cells, min_area_m2, quality, threads);
    if (level.penalty > 0)
        for (DetectedObject& object : judged.objects)
            object.confidence = less_sure(object.confidence, level.penalty);
    return judged;
}

}  // namespace

void clear_with_border(const Regions& regions, Mask& cells, Executor& threads) {
    for_rows(threads, cells.rows, cells.cols, [&](std::int32_t r) {
        for (std::int32_t y = std::max(r - 1, 0); y <= std::min(r + 1, cells.rows - 1); ++y) {
            const std::int32_t beside = y == r ? 1 : 0;
            for (const RegionRun& run : regions.row(y))
                std::fill(cells.row(r).begin() + std::max(run.begin - beside, 0),
                          cells.row(r).begin() + std::min(run.end + beside, cells.cols), std::uint8_t{0});
        }
    });
}

Candidates select_candidates(std::span<const Candidates> passes, std::size_t usual, Executor& threads) {
    std::vector<Chosen> chosen = choose(passes);
    const Regions& shape = passes[usual].regions;
    Mask taken(shape.rows, shape.cols, 0, threads);
    const auto paint_chosen = [&](const Regions& regions, const Chosen& of) {
        paint(
            regions, [&](Label label) { return of[label] != 0; }, 1, taken, threads);
    };
    for (std::size_t i = 0; i < passes.size(); ++i)
        paint_chosen(passes[i].regions, chosen[i]);
    keep_separate(taken, shape, chosen[usual]);
    paint_chosen(shape, chosen[usual]);
    return merge_selected(passes, chosen, taken, passes[usual].rejected, threads);
}

Candidates multi_threshold_candidates(const Scene& scene, SceneCells& cells, double min_area_m2,
                                      const SurfaceQuality& quality, Candidates usual, Executor& threads) {
    std::vector<Candidates> passes(levels.size() - (has_very_sparse_points(quality.filled) ? 0 : 1));
    passes[regular_level] = std::move(usual);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (i + 1 == levels.size())
            clear_with_border(passes[regular_level].regions, cells.elevated, threads);
        if (i != regular_level)
            passes[i] = found_at(levels[i], scene, cells, min_area_m2, quality, threads);
    }
    return select_candidates(passes, regular_level, threads);
}

Candidates merge_candidates(std::span<const Candidates> passes, Executor& threads) {
    Mask cells = mask_of(passes.front().regions, threads);
    std::vector<Chosen> all;
    for (const Candidates& pass : passes) {
        all.emplace_back(pass.objects.size() + 1, 1);
        paint(
            pass.regions, [](Label) { return true; }, 1, cells, threads);
    }
    return merge_selected(passes, all, cells, passes.front().rejected, threads);
}

}  // namespace d2b::detect
