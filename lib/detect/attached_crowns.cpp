#include "detect/attached_crowns.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/row_bands.hpp"
#include "detect/crown_cuts.hpp"
#include "detect/evidence.hpp"
#include "detect/left_out.hpp"
#include "detect/morphology.hpp"
#include "detect/part_seam.hpp"

namespace d2b {
namespace {

constexpr double large_segment_m2 = 50;
constexpr double eaves_m = 1;
constexpr double least_crown_m2 = 4;

/// Returns the cells of large smooth segments.
Mask roofs_of(const Scene& scene, const SmoothSegments& segments, const Mask& objects, Executor& threads) {
    const std::int64_t least = cells_for(large_segment_m2, scene.cell);
    Mask roofs(objects.rows, objects.cols, 0, threads);
    for_row_bands(threads, objects.rows, objects.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (const RegionRun& run : segments.regions.row(r))
                if (segments.pieces[run.label - 1].cells >= least)
                    std::copy(objects.row(r).begin() + run.begin, objects.row(r).begin() + run.end,
                              roofs.row(r).begin() + run.begin);
    });
    return roofs;
}

Regions parts_beside(const Mask& roofs, const Mask& objects, std::int64_t least_cells, Executor& threads) {
    Mask rest = Mask::unset(objects.rows, objects.cols, threads);
    for_row_bands(threads, objects.rows, objects.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const std::span<const std::uint8_t> object = objects.row(r);
            const std::span<const std::uint8_t> roof = roofs.row(r);
            const std::span<std::uint8_t> out = rest.row(r);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c] = object[c] > roof[c] ? 1 : 0;
        }
    });
    return connected_regions(rest, 1, least_cells, threads);
}

/// Clears the parts to be cut. Regions are numbered in the order of their first cells.
std::vector<CutCrown> clear(const Regions& parts, const std::vector<std::vector<CutLine>>& cuts,
                            Mask& objects) {
    std::vector<CutCrown> crowns;
    Label seen = 0;
    for (std::int32_t r = 0; r < parts.rows; ++r)
        for (const RegionRun& run : parts.row(r)) {
            if (cuts[run.label - 1].empty())
                continue;
            std::fill(objects.row(r).begin() + run.begin, objects.row(r).begin() + run.end, std::uint8_t{0});
            if (run.label > seen) {
                seen = run.label;
                crowns.push_back({{r, run.begin}, parts.cells[seen]});
            }
        }
    return crowns;
}

/// Relabels the remaining cells. Each new object inherits the classification of the object it was part of.
void gather(const Mask& cells, std::int64_t least_cells, JudgedObjects& judged, Executor& threads) {
    JudgedObjects left;
    left.regions = connected_regions(cells, 1, 0, threads);
    const std::vector<FirstCell> small = take_small_out(left.regions, least_cells);
    judged.left_out.small.insert(judged.left_out.small.end(), small.begin(), small.end());
    for (std::int32_t r = 0; r < cells.rows; ++r)
        for (const RegionRun& run : left.regions.row(r))
            if (run.label > left.objects.size()) {
                const std::span<const RegionRun> before = judged.regions.row(r);
                const auto whole = std::ranges::partition_point(
                    before, [&](const RegionRun& other) { return other.end <= run.begin; });
                left.objects.push_back(judged.objects[whole->label - 1]);
                left.objects.back().cells = left.regions.cells[run.label];
                left.evidence.push_back(judged.evidence[whole->label - 1]);
            }
    judged.regions = std::move(left.regions);
    judged.objects = std::move(left.objects);
    judged.evidence = std::move(left.evidence);
}

}  // namespace

std::vector<CutCrown> take_crowns_off(const Scene& scene, const SmoothSegments& segments,
                                      const Grid<std::uint8_t>& flags, std::int64_t least_cells, Mask cells,
                                      JudgedObjects& judged, Executor& threads) {
    const int eaves = std::max(1, static_cast<int>(std::lround(eaves_m / scene.side())));
    const Mask roofs = roofs_of(scene, segments, cells, threads);
    const Mask near_roofs = grown(roofs, cells, eaves, threads);
    DetectedObjects parts{std::move(cells), {}};
    parts.regions = parts_beside(near_roofs, parts.cells, cells_for(least_crown_m2, scene.cell), threads);
    const std::vector<PartSeam> seams = seams_of(parts, near_roofs, scene.cell, threads);
    const std::vector<Evidence> evidence = collect_evidence(scene, parts, segments, flags, threads);
    std::vector<std::vector<CutLine>> cuts(seams.size());
    threads.for_each(seams.size(), [&](std::size_t i) {
        cuts[i] = crown_cuts(seams[i], evidence[i], parts.cells, scene.cell, eaves);
    });
    std::vector<CutCrown> crowns = clear(parts.regions, cuts, parts.cells);
    for (const std::vector<CutLine>& lines : cuts)
        for (const CutLine& cut : lines)
            clear_outside(cut.seam, cut.wall, roofs, scene.cell, parts.cells);
    if (!crowns.empty())
        gather(parts.cells, least_cells, judged, threads);
    return crowns;
}

}  // namespace d2b
