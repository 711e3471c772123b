#include "detect/second_look.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/row_bands.hpp"
#include "detect/odds.hpp"
#include "detect/place_prior.hpp"

namespace d2b {
namespace {

// Fitted on La Rochelle, on simulated sparse scans of high-resolution places, and on scenes, see
// docs/accuracy.md.
constexpr double least_filled = 0.1;
constexpr double allowance = 3;
constexpr double caution = 0.8;  // penalty on the log-odds

/// Clears the cells of regions and their eight neighbours.
void leave_out(const Regions& regions, Mask& cells, Executor& threads) {
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (std::int32_t y = std::max(r - 1, 0); y <= std::min(r + 1, cells.rows - 1); ++y)
                for (const RegionRun& run : regions.row(y))
                    std::fill(cells.row(r).begin() + std::max(run.begin - 1, 0),
                              cells.row(r).begin() + std::min(run.end + 1, cells.cols), std::uint8_t{0});
    });
}

/// Returns the run that contains a column, or null.
const RegionRun* run_at(std::span<const RegionRun> row, std::int32_t col) {
    const auto run =
        std::ranges::partition_point(row, [&](const RegionRun& before) { return before.end <= col; });
    return run != row.end() && run->begin <= col ? &*run : nullptr;
}

}  // namespace

bool deserves_second_look(double filled) {
    return filled > least_filled;
}

JudgedObjects second_look(const Scene& scene, SceneCells& cells, double smallest_m2, SurfaceQuality quality,
                          const Regions& found, Executor& threads) {
    leave_out(found, cells.elevated, threads);
    quality.allowance = allowance;
    JudgedObjects judged = judged_objects(scene, cells, smallest_m2, quality, threads);
    judged.left_out.small.clear();
    for (DetectedObject& object : judged.objects)
        if (is_candidate(object))
            object.confidence = less_sure(object.confidence, caution);
    return judged;
}

JudgedObjects united(JudgedObjects one, const JudgedObjects& other, Executor& threads) {
    Mask cells = mask_of(one.regions, threads);
    for (std::int32_t r = 0; r < cells.rows; ++r)
        for (const RegionRun& run : other.regions.row(r))
            std::fill(cells.row(r).begin() + run.begin, cells.row(r).begin() + run.end, std::uint8_t{1});
    JudgedObjects both;
    both.regions = connected_regions(cells, 1, 0, threads);
    // Regions are numbered in the order of their first cells.
    for (std::int32_t r = 0; r < cells.rows; ++r)
        for (const RegionRun& run : both.regions.row(r))
            if (run.label > both.objects.size()) {
                const JudgedObjects& source = run_at(one.regions.row(r), run.begin) != nullptr ? one : other;
                const Label label = run_at(source.regions.row(r), run.begin)->label;
                both.objects.push_back(source.objects[label - 1]);
                both.evidence.push_back(source.evidence[label - 1]);
            }
    both.left_out = std::move(one.left_out);
    both.left_out.crowns.insert(both.left_out.crowns.end(), other.left_out.crowns.begin(),
                                other.left_out.crowns.end());
    return both;
}

}  // namespace d2b
